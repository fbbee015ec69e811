// What the tests of mesh files share: options without the cache, and the text of a glTF file.
#pragma once
#include <CGAL/version.h>
#include <fmt/format.h>

#include <optional>
#include <string>

#include "harness/mesh/mesh.hpp"
#include "tests/support/files.hpp"

namespace pelage {

/// Returns options with which load_model() prepares a mesh without the cache.
inline MeshOptions fresh(std::optional<std::uint32_t> faces = {}, bool keep_uv = false) {
  MeshOptions options;
  options.faces = faces;
  options.keep_uv = keep_uv;
  options.cache = false;
  return options;
}

/// Hashes of meshes in tests are those with the version of CGAL in Debian 12.
inline constexpr bool bits_of_cgal = CGAL_VERSION_NR == 1050511000;

namespace test {

/// Appends the bytes of a number.
template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Returns a glTF file as most exporters write it: the buffer file `uri` has the points (3 floats each), then
/// the corners of the faces (16-bit integers).
inline std::string gltf_text(const std::string& uri, std::size_t points, std::size_t corners) {
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
"buffers":[{{"byteLength":{2},"uri":"{0}"}}],
"bufferViews":[{{"buffer":0,"byteLength":{1}}},{{"buffer":0,"byteOffset":{1},"byteLength":{3}}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":{4},"type":"VEC3","min":[-2,-2,-2],"max":[2,2,2]}},
{{"bufferView":1,"componentType":5123,"count":{5},"type":"SCALAR"}}]}})",
      uri, 12 * points, 12 * points + 2 * corners, 2 * corners, points, corners);
}

}  // namespace test
}  // namespace pelage
