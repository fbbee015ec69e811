// Reads the triangles of 3DS files. The vertices of the file lie in the world: its local frames (chunk
// 0x4160) and its animation are not used.
#include <fmt/format.h>

#include <cstring>
#include <utility>

#include "harness/mesh/read/formats.hpp"
#include "harness/mesh/read/text.hpp"

namespace pelage::detail {
namespace {

enum : std::uint16_t {
  main_chunk = 0x4d4d,
  editor = 0x3d3d,
  object = 0x4000,
  triangles = 0x4100,
  points = 0x4110,
  faces = 0x4120,
  map = 0x4140
};

/// Reads little-endian numbers of the content of a chunk.
class Content {
 public:
  Content(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

  bool empty() const { return rest_.size() < 6; }  // fewer bytes than the head of a chunk
  template <class T>
  T next() {
    T value;
    const std::string_view bytes = take(sizeof value);
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }

  std::string_view take(std::size_t size) {
    if (size > rest_.size()) fail(name_, 0, "a chunk ends early; the file is damaged");
    return std::exchange(rest_, rest_.substr(size)).substr(0, size);
  }

  /// Returns the type and the content of the next chunk. Its length contains the 6 bytes of type and length.
  std::pair<std::uint16_t, std::string_view> chunk() {
    const auto type = next<std::uint16_t>();
    const auto length = next<std::uint32_t>();
    if (length < 6) fail(name_, 0, fmt::format("a chunk has the length {}", length));
    return {type, take(length - 6)};
  }

  /// Passes over a text that ends with a zero.
  void text() { take(std::min(rest_.find('\0'), rest_.size()) + 1); }

 private:
  std::string_view rest_;
  const std::string& name_;
};

class ThreeDs {
 public:
  ThreeDs(const std::string& name, bool with_uv) : name_(name), with_uv_(with_uv) {}

  Soup read(std::string_view bytes) {
    Content file(bytes, name_);
    const auto [type, content] = file.chunk();
    if (type != main_chunk) fail(name_, 0, "not a 3DS file");
    add_chunks(content);
    if (std::ranges::all_of(soup_.uv, [](const auto& uv) { return uv.empty(); })) soup_.uv.clear();
    return std::move(soup_);
  }

 private:
  void add_chunks(std::string_view bytes) {
    for (Content in(bytes, name_); !in.empty();) {
      const auto [type, bytes_of_chunk] = in.chunk();
      Content content(bytes_of_chunk, name_);
      if (type == editor) add_chunks(bytes_of_chunk);
      if (type != object) continue;
      content.text();
      while (!content.empty())
        if (const auto [part, mesh] = content.chunk(); part == triangles) add_mesh(mesh);
    }
  }

  void add_mesh(std::string_view bytes) {
    std::vector<glm::dvec3> point;
    std::vector<glm::dvec2> uv;
    std::vector<std::uint16_t> corner;
    for (Content in(bytes, name_); !in.empty();) {
      const auto [type, bytes_of_chunk] = in.chunk();
      if (type != points && type != faces && type != map) continue;
      Content content(bytes_of_chunk, name_);
      for (int left = content.next<std::uint16_t>(); left > 0; --left) {
        float x[3];
        if (type != faces)
          for (int k = 0; k < (type == map ? 2 : 3); ++k) x[k] = content.next<float>();
        // The z axis of 3DS points up.
        if (type == points) point.emplace_back(x[0], x[2], -x[1]);
        if (type == map) uv.emplace_back(x[0], x[1]);
        if (type == faces) {
          for (int k = 0; k < 3; ++k) corner.push_back(content.next<std::uint16_t>());
          content.next<std::uint16_t>();  // which edges are drawn
        }
      }
    }
    add_faces(point, uv, corner);
  }

  void add_faces(const std::vector<glm::dvec3>& point, const std::vector<glm::dvec2>& uv,
                 const std::vector<std::uint16_t>& corner) {
    const bool mapped = with_uv_ && !uv.empty();
    if (mapped && uv.size() != point.size())
      fail(name_, 0, fmt::format("{} vertices have {} texture coordinates", point.size(), uv.size()));
    for (std::size_t c = 0; c < corner.size(); ++c) {
      const std::size_t i = corner[c];
      if (i >= point.size())
        fail(name_, 0, fmt::format("a face has the vertex {}; there are {}", i, point.size()));
      if (c % 3 == 0) soup_.polygon.emplace_back(), soup_.uv.emplace_back();
      soup_.polygon.back().push_back(std::uint32_t(soup_.point.size()));
      soup_.point.push_back(point[i]);
      if (!mapped) continue;
      if (!(std::abs(uv[i].x) <= largest_coordinate && std::abs(uv[i].y) <= largest_coordinate))
        fail(name_, 0, "a texture coordinate is not a number");
      soup_.uv.back().push_back(uv[i]);
    }
  }

  const std::string& name_;
  bool with_uv_;
  Soup soup_;
};

}  // namespace

Soup read_3ds(std::string_view bytes, const std::string& name, bool with_uv) {
  return ThreeDs(name, with_uv).read(bytes);
}

}  // namespace pelage::detail
