// The text of a glTF file whose buffer is a file of its own, as most exporters write it.
#pragma once
#include <fmt/format.h>

#include <string>

namespace pelage::test {

/// The buffer file `uri` has the points (3 floats each), then the corners of the faces (16-bit integers).
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

}  // namespace pelage::test
