#include <fmt/format.h>

#include <charconv>
#include <cstring>
#include <nlohmann/json.hpp>

#include "harness/error.hpp"
#include "harness/mesh/read/formats.hpp"

namespace pelage::detail {
namespace {

namespace fs = std::filesystem;

/// Replaces each percent-encoded byte by the byte itself, for example %20 by a space.
std::string decoded(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned code = 0;
    if (uri[i] == '%' && i + 2 < uri.size()) {
      const auto [end, error] = std::from_chars(&uri[i + 1], &uri[i + 3], code, 16);
      if (error == std::errc{} && end == &uri[i + 3]) {
        text += char(code);
        i += 2;
        continue;
      }
    }
    text += uri[i];
  }
  return text;
}

}  // namespace

GltfParts gltf_parts(std::string_view bytes, const std::string& name) {
  constexpr std::size_t header = 12, chunk = 8;
  if (!bytes.starts_with("glTF")) return {bytes, {}};
  const auto number_at = [&](std::size_t place) {
    std::uint32_t number = 0;
    if (place + sizeof number <= bytes.size()) std::memcpy(&number, &bytes[place], sizeof number);
    return std::size_t(number);
  };
  if (number_at(4) != 2)
    throw InputError(fmt::format("{}: a binary file of version {}; version 2 is read", name, number_at(4)));
  const std::size_t text = number_at(header), binary = header + chunk + text;
  const std::size_t size = binary + chunk <= bytes.size() ? number_at(binary) : 0;
  if (binary > bytes.size() || (size > 0 && size > bytes.size() - binary - chunk))
    throw InputError(fmt::format("{}: the file ends early", name));
  return {bytes.substr(header + chunk, text),
          size > 0 ? bytes.substr(binary + chunk, size) : std::string_view()};
}

std::vector<fs::path> gltf_files(const fs::path& file) {
  const std::string ending = ending_of(file);
  if (ending != "gltf" && ending != "glb") return {};
  return gltf_files(read_bytes(file, largest_mesh_file), file);
}

std::vector<fs::path> gltf_files(std::string_view bytes, const fs::path& file) {
  const auto json = nlohmann::json::parse(gltf_parts(bytes, file.string()).json, nullptr, false);
  std::vector<fs::path> files;
  if (!json.is_object()) return files;
  for (const char* list : {"buffers", "images"}) {
    if (!json.contains(list) || !json.at(list).is_array()) continue;
    for (const auto& entry : json.at(list)) {
      if (!entry.is_object() || !entry.contains("uri") || !entry.at("uri").is_string()) continue;
      const std::string uri = decoded(entry.at("uri").get<std::string>());
      if (uri.starts_with("data:")) continue;
      const fs::path path = fs::path(uri).lexically_normal();
      if (path.is_absolute() || path.empty() || *path.begin() == ".." || uri.find("://") != std::string::npos)
        throw InputError(
            fmt::format("{}: this glTF file refers to '{}'; it may refer only to files in its own folder",
                        file.string(), uri));
      files.push_back(file.parent_path() / path);
      std::error_code error;
      if (!fs::is_regular_file(files.back(), error))
        throw InputError(
            fmt::format("{}: this glTF file refers to '{}', which does not exist or is not a regular file",
                        file.string(), uri));
    }
  }
  return files;
}

}  // namespace pelage::detail
