// Reads glTF 2.0. tinygltf reads the JSON and the data URIs; this file reads the accessors, whose numbers may
// be quantized or sparse, and places the meshes by their nodes.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

// tinygltf is compiled here, not linked, so that it has the options below.
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_INCLUDE_JSON
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>
#include <limits>

#include "harness/error.hpp"
#include "harness/mesh/read/formats.hpp"

namespace pelage::detail {
namespace {

// Extensions that a file may require: quantized numbers, and those that change only materials, lights and
// pictures.
constexpr std::array<std::string_view, 6> known{"KHR_mesh_quantization", "KHR_materials_", "KHR_texture_",
                                                "KHR_lights_",           "EXT_texture_",   "MSFT_texture_"};

class Gltf {
 public:
  Gltf(const tinygltf::Model& model, std::string name, bool with_uv)
      : model_(model), name_(std::move(name)), with_uv_(with_uv) {}

  Soup read() {
    const auto newer = [](const std::string& version) { return !version.empty() && version != "2.0"; };
    if (!model_.asset.version.starts_with("2.") || newer(model_.asset.minVersion))
      fail(fmt::format("the file has the version {}; version 2.0 is read",
                       newer(model_.asset.minVersion) ? model_.asset.minVersion : model_.asset.version));
    for (const std::string& extension : model_.extensionsRequired)
      if (std::ranges::none_of(known, [&](std::string_view start) { return extension.starts_with(start); }))
        fail(fmt::format("the file requires the extension {}, which pelage does not read", extension));
    const int scene = std::max(0, model_.defaultScene);
    if (std::size_t(scene) < model_.scenes.size()) {
      for (const int node : model_.scenes[std::size_t(scene)].nodes) add_node(node, glm::dmat4(1), 0);
    } else {  // a library of meshes
      for (const tinygltf::Mesh& mesh : model_.meshes) add_mesh(mesh, mesh.weights, glm::dmat4(1));
    }
    if (std::ranges::all_of(soup_.uv, [](const auto& uv) { return uv.empty(); })) soup_.uv.clear();
    return std::move(soup_);
  }

 private:
  using Numbers = std::vector<double>;

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {}", name_, what));
  }

  /// Returns the element with this index of a list of the file.
  template <class T>
  const T& at(const std::vector<T>& list, int index, const char* what) const {
    if (index < 0 || std::size_t(index) >= list.size())
      fail(fmt::format("{} {} does not exist; there are {}", what, index, list.size()));
    return list[std::size_t(index)];
  }

  static glm::dmat4 transform_of(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
    glm::dmat4 matrix(1);
    if (node.translation.size() == 3)
      matrix[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1);
    if (const auto& r = node.rotation; r.size() == 4)
      matrix *= glm::mat4_cast(glm::dquat(r[3], r[0], r[1], r[2]));
    if (node.scale.size() == 3)
      for (int i = 0; i < 3; ++i) matrix[i] *= node.scale[std::size_t(i)];
    return matrix;
  }

  void add_node(int index, const glm::dmat4& parent, std::size_t depth) {
    const tinygltf::Node& node = at(model_.nodes, index, "node");
    if (depth > 1000 || ++visited_ > model_.nodes.size()) fail("the nodes do not form a tree");
    const glm::dmat4 matrix = parent * transform_of(node);
    if (node.mesh >= 0) {
      const tinygltf::Mesh& mesh = at(model_.meshes, node.mesh, "mesh");
      // The joints place a skinned mesh, not its node.
      add_mesh(mesh, node.weights.empty() ? mesh.weights : node.weights,
               node.skin < 0 ? matrix : glm::dmat4(1));
    }
    for (const int child : node.children) add_node(child, matrix, depth + 1);
  }

  void add_mesh(const tinygltf::Mesh& mesh, const Numbers& weights, const glm::dmat4& matrix) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
      const auto position = primitive.attributes.find("POSITION");
      if (mode < TINYGLTF_MODE_TRIANGLES || position == primitive.attributes.end()) continue;
      Numbers points = numbers(position->second, 3);
      for (std::size_t t = 0; t < std::min(weights.size(), primitive.targets.size()); ++t)
        if (const auto moved = primitive.targets[t].find("POSITION");
            weights[t] != 0 && moved != primitive.targets[t].end()) {
          const Numbers shift = numbers(moved->second, 3);
          for (std::size_t i = 0; i < std::min(points.size(), shift.size()); ++i)
            points[i] += weights[t] * shift[i];
        }
      const auto first = std::uint32_t(soup_.point.size());
      for (std::size_t i = 0; i < points.size(); i += 3)
        soup_.point.emplace_back(matrix * glm::dvec4(points[i], points[i + 1], points[i + 2], 1));
      const auto uv = primitive.attributes.find("TEXCOORD_0");
      const Numbers at_uv = with_uv_ && uv != primitive.attributes.end() ? numbers(uv->second, 2) : Numbers();
      for (const double value : at_uv)
        if (!(std::abs(value) <= largest_coordinate)) fail("a texture coordinate is not a number");
      add_triangles(indices_of(primitive, points.size() / 3), mode, glm::determinant(matrix) < 0, first,
                    at_uv);
    }
  }

  std::vector<std::uint32_t> indices_of(const tinygltf::Primitive& primitive, std::size_t points) {
    std::vector<std::uint32_t> indices;
    if (primitive.indices < 0)
      for (std::uint32_t i = 0; i < points; ++i) indices.push_back(i);
    else
      for (const double index : numbers(primitive.indices, 1)) {
        if (!(index >= 0 && index < double(points)))
          fail(fmt::format("a face has the vertex {:.0f}; there are {}", index, points));
        indices.push_back(std::uint32_t(index));
      }
    return indices;
  }

  /// A mirrored mesh has its faces turned, as the specification says.
  void add_triangles(const std::vector<std::uint32_t>& index, int mode, bool mirrored, std::uint32_t first,
                     const Numbers& uv) {
    const bool list = mode == TINYGLTF_MODE_TRIANGLES;
    for (std::size_t i = 2; i < index.size(); i += list ? 3 : 1) {
      std::array<std::uint32_t, 3> t{index[i - 2], index[i - 1], index[i]};
      if (mode == TINYGLTF_MODE_TRIANGLE_FAN) t[0] = index[0];
      if ((mode == TINYGLTF_MODE_TRIANGLE_STRIP && i % 2 == 1) != mirrored) std::swap(t[1], t[2]);
      auto& corners = soup_.uv.emplace_back();
      auto& polygon = soup_.polygon.emplace_back();
      for (const std::size_t k : t) {
        polygon.push_back(first + std::uint32_t(k));
        // The origin of a glTF picture is its upper left corner.
        if (2 * k + 1 < uv.size()) corners.emplace_back(uv[2 * k], 1 - uv[2 * k + 1]);
      }
    }
  }

  /// Returns the numbers of an accessor, `width` for each of its elements.
  Numbers numbers(int index, int width) {
    const tinygltf::Accessor& accessor = at(model_.accessors, index, "accessor");
    if (tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type)) != width)
      fail(fmt::format("accessor {} has elements of another type; {} numbers are needed", index, width));
    if (accessor.count > most_numbers)
      fail(fmt::format("accessor {} has {} elements", index, accessor.count));
    Numbers values(accessor.count * std::size_t(width), 0);
    if (accessor.bufferView >= 0)
      copy(
          accessor.bufferView, accessor.byteOffset, accessor.componentType, accessor.normalized, width,
          [&](std::size_t i) -> double& { return values[i]; }, accessor.count);
    if (accessor.sparse.isSparse) {
      const auto& sparse = accessor.sparse;
      const auto count = std::size_t(std::max(0, sparse.count));
      if (count > accessor.count)
        fail(fmt::format("accessor {} is sparse, but has more values than elements", index));
      Numbers places(count), changed(count * std::size_t(width));
      copy(
          sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset), sparse.indices.componentType,
          false, 1, [&](std::size_t i) -> double& { return places[i]; }, count, true);
      copy(
          sparse.values.bufferView, std::size_t(sparse.values.byteOffset), accessor.componentType,
          accessor.normalized, width, [&](std::size_t i) -> double& { return changed[i]; }, count, true);
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < std::size_t(width); ++k) {
          if (!(places[i] >= 0 && places[i] < double(accessor.count)))
            fail(fmt::format("accessor {} is sparse, and changes an element that does not exist", index));
          values[std::size_t(places[i]) * std::size_t(width) + k] = changed[i * std::size_t(width) + k];
        }
    }
    return values;
  }

  /// Reads `count` elements of `width` numbers from a buffer view. `tight`: they have no bytes between them.
  template <class To>
  void copy(int index, std::size_t offset, int type, bool normalized, int width, const To& to,
            std::size_t count, bool tight = false) const {
    const tinygltf::BufferView& view = at(model_.bufferViews, index, "buffer view");
    const tinygltf::Buffer& buffer = at(model_.buffers, view.buffer, "buffer");
    const int bytes = tinygltf::GetComponentSizeInBytes(std::uint32_t(type));
    if (bytes <= 0 || type == TINYGLTF_COMPONENT_TYPE_INT || type == TINYGLTF_COMPONENT_TYPE_DOUBLE)
      fail(fmt::format("the component type {} is unknown", type));
    const std::size_t size = std::size_t(bytes) * std::size_t(width);
    const std::size_t stride = tight || view.byteStride == 0 ? size : view.byteStride;
    const std::size_t end = count == 0 ? 0 : offset + stride * (count - 1) + size;
    if (end > view.byteLength || view.byteOffset > buffer.data.size() ||
        view.byteLength > buffer.data.size() - view.byteOffset)
      fail(fmt::format("buffer view {} has {} bytes; {} are needed", index, view.byteLength, end));
    const unsigned char* data = buffer.data.data() + view.byteOffset + offset;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < std::size_t(width); ++k)
        to(i * std::size_t(width) + k) =
            component(data + i * stride + k * std::size_t(bytes), type, normalized);
  }

  template <class T>
  static double value(const unsigned char* bytes, bool normalized) {
    T number;
    std::memcpy(&number, bytes, sizeof number);
    if constexpr (std::is_integral_v<T>)
      if (normalized) return std::max(-1.0, double(number) / double(std::numeric_limits<T>::max()));
    return double(number);
  }

  static double component(const unsigned char* bytes, int type, bool normalized) {
    switch (type) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return value<std::int8_t>(bytes, normalized);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return value<std::uint8_t>(bytes, normalized);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return value<std::int16_t>(bytes, normalized);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return value<std::uint16_t>(bytes, normalized);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return value<std::uint32_t>(bytes, normalized);
      default:
        return value<float>(bytes, normalized);
    }
  }

  static constexpr std::size_t most_numbers = 100'000'000;
  const tinygltf::Model& model_;
  std::string name_;
  bool with_uv_;
  Soup soup_;
  std::size_t visited_ = 0;
};

}  // namespace

Soup read_gltf(const std::string& bytes, const std::filesystem::path& file, bool with_uv) {
  const std::string name = file.string();
  const auto refuse = [&](std::string why) {
    std::ranges::replace(why, '\n', ' ');
    throw InputError(fmt::format("{}: not readable: {}", name, why.empty() ? "invalid glTF" : why));
  };
  // tinygltf reads a + in a URI as a space and refuses files that are longer than their buffers. It therefore
  // gets the contents of the buffers under the names "0", "1", ..., and neither pictures nor a binary file.
  std::vector<std::string> contents;
  const GltfParts parts = gltf_parts(bytes, name);
  std::vector<std::filesystem::path> files = gltf_files(bytes, file);
  nlohmann::json json = nlohmann::json::parse(parts.json, nullptr, false);
  if (!json.is_object()) refuse("its JSON text is damaged");
  json.erase("images");
  if (nlohmann::json& buffers = json["buffers"]; buffers.is_array())
    for (std::size_t i = 0; i < buffers.size(); ++i) {
      if (!buffers[i].is_object() || !buffers[i]["byteLength"].is_number_unsigned())
        refuse(fmt::format("buffer {} has no byteLength", i));
      const bool outside = buffers[i]["uri"].is_string();
      if (const std::string uri = outside ? buffers[i]["uri"].get<std::string>() : "";
          uri.starts_with("data:")) {
        const std::size_t content = uri.find(";base64,");  // tinygltf knows some of the types before it
        if (content == uri.npos) refuse(fmt::format("buffer {}: the data URI is not in base64", i));
        buffers[i]["uri"] = "data:application/octet-stream" + uri.substr(content);
        continue;
      }
      if (!outside && i > 0) refuse(fmt::format("buffer {} has no content", i));
      contents.push_back(outside ? read_bytes(files.front(), largest_mesh_file) : std::string(parts.binary));
      if (outside) files.erase(files.begin());
      if (const auto need = buffers[i]["byteLength"].get<std::size_t>(); need > contents.back().size())
        refuse(fmt::format("buffer {} has {} bytes; {} are needed", i, contents.back().size(), need));
      buffers[i]["byteLength"] = contents.back().size();
      buffers[i]["uri"] = std::to_string(contents.size() - 1);
    }
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(
      {[](const std::string&, void*) { return true; }, [](const std::string& uri, void*) { return uri; },
       [](std::vector<unsigned char>* to, std::string*, const std::string& uri, void* from) {
         auto& all = *static_cast<std::vector<std::string>*>(from);
         const std::size_t place = std::strtoul(uri.c_str(), nullptr, 10);
         if (place < all.size()) to->assign(all[place].begin(), all[place].end());
         return place < all.size();
       },
       nullptr, &contents});
  tinygltf::Model model;
  std::string error, warning;
  const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (!loader.LoadASCIIFromString(&model, &error, &warning, text.data(), unsigned(text.size()), ""))
    refuse(error);
  return Gltf(model, name, with_uv).read();
}

}  // namespace pelage::detail
