// Tests that meshes which other programs write in unusual ways give the surface and the UV map of the plain
// file, or are refused. Each is a box, whose sides have cells of their own in the UV map.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/geometric.hpp>
#include <tuple>

#include "harness/error.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/mesh/read/soup.hpp"
#include "tests/mesh/mesh_files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using test::put;

/// A box of 24 corners: four for each side. Each side is two triangles.
struct Box {
  std::vector<glm::dvec3> point;
  std::vector<glm::dvec2> uv;
  std::vector<std::array<int, 3>> triangle;
};

Box box() {
  Box made;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    const double sign = side % 2 == 0 ? 1 : -1;
    const int first = 4 * side, column = side % 3, row = side / 3;
    for (int k = 0; k < 4; ++k) {
      const double a = k == 1 || k == 2 ? 1 : -1, b = k >= 2 ? 1 : -1;
      glm::dvec3 p;
      p[axis] = sign;
      p[(axis + 1) % 3] = sign * a;
      p[(axis + 2) % 3] = b;
      made.point.push_back(p * glm::dvec3(1, 0.75, 0.5));
      made.uv.emplace_back((column + 0.125 + 0.375 * (a + 1)) / 4, (row + 0.125 + 0.375 * (b + 1)) / 4);
    }
    made.triangle.push_back({first, first + 1, first + 2});
    made.triangle.push_back({first, first + 2, first + 3});
  }
  return made;
}

std::string obj_of(const Box& box, const std::string& point = "v {} {} {}\n") {
  std::string text;
  for (const glm::dvec3& p : box.point) text += fmt::format(fmt::runtime(point), p.x, p.y, p.z);
  for (const glm::dvec2& p : box.uv) text += fmt::format("vt {} {}\n", p.x, p.y);
  for (const auto& [a, b, c] : box.triangle)
    text += fmt::format("f {0}/{0} {1}/{1} {2}/{2}\n", a + 1, b + 1, c + 1);
  return text;
}

/// The corners of the soup's triangles in one order: their place and UV.
std::vector<std::array<double, 5>> corners_of(const Soup& soup) {
  std::vector<std::array<double, 5>> corners;
  for (std::size_t f = 0; f < soup.polygon.size(); ++f)
    for (std::size_t k = 0; k < soup.polygon[f].size(); ++k) {
      const glm::dvec3 p = soup.point[soup.polygon[f][k]];
      const glm::dvec2 uv = soup.uv.empty() || soup.uv[f].empty() ? glm::dvec2(0) : soup.uv[f][k];
      corners.push_back({p.x, p.y, p.z, uv.x, uv.y});
      for (double& x : corners.back()) x = std::round(x * 1e6) / 1e6 + 0.0;
    }
  std::ranges::sort(corners);
  return corners;
}

/// How a glTF file stores numbers.
struct Storage {
  int component = 5126;  ///< glTF's number of the type
  bool normalized = false;
  std::function<void(std::string&, double)> append = [](std::string& bytes, double x) {
    put(bytes, float(x));
  };
};

const Storage u8{5121, true,
                 [](std::string&bytes, double x) { put(bytes, std::uint8_t(std::lround(x * 255))); }},
    u16{5123, true, [](std::string&bytes, double x) { put(bytes, std::uint16_t(std::lround(x * 65535))); }},
    s16{5122, true, [](std::string&bytes, double x) { put(bytes, std::int16_t(std::lround(x * 32767))); }},
    u16_eighths{5123, false,
                [](std::string&bytes, double x) { put(bytes, std::uint16_t(std::lround(8 * x + 8))); }};

/// Writes the box as glTF with the node's members `node` (JSON), and returns the path.
std::string gltf_of(const test::Folder& folder, const Box& box, const Storage& points = {},
                    const Storage& uv = {}, const std::string& node = "", const std::string& rest = "",
                    bool binary = false) {
  std::string bytes;
  const auto padded = [&] { bytes.resize((bytes.size() + 3) / 4 * 4); };
  for (const glm::dvec3& p : box.point) {
    for (int i = 0; i < 3; ++i) points.append(bytes, p[i]);
    padded();
  }
  const std::size_t point_bytes = bytes.size();
  for (const glm::dvec2& p : box.uv) {
    uv.append(bytes, p.x), uv.append(bytes, 1 - p.y);
    padded();
  }
  const std::size_t uv_bytes = bytes.size() - point_bytes, index = bytes.size();
  for (const auto& t : box.triangle)
    for (const int i : t) put(bytes, std::uint16_t(i));
  const std::size_t n = box.point.size();
  const std::string uri = binary ? "" : R"("uri":"box.bin",)";
  const std::string json = fmt::format(
      R"({{"asset":{{"version":"2.0"}},{}"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0{}}}],)"
      R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":2}}]}}],)"
      R"("accessors":[{{"bufferView":0,"componentType":{},"normalized":{},"count":{},"type":"VEC3"}},)"
      R"({{"bufferView":1,"componentType":{},"normalized":{},"count":{},"type":"VEC2"}},)"
      R"({{"bufferView":2,"componentType":5123,"count":{},"type":"SCALAR"}}],)"
      R"("bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":{},"byteStride":{}}},)"
      R"({{"buffer":0,"byteOffset":{},"byteLength":{},"byteStride":{}}},)"
      R"({{"buffer":0,"byteOffset":{},"byteLength":{}}}],"buffers":[{{{}"byteLength":{}}}]}})",
      rest, node, points.component, points.normalized, n, uv.component, uv.normalized, n,
      3 * box.triangle.size(), point_bytes, point_bytes / n, point_bytes, uv_bytes, uv_bytes / n, index,
      bytes.size() - index, uri, bytes.size());
  if (!binary) {
    folder.write("box.bin", bytes);
    return folder.write("box.gltf", json);
  }
  std::string text = json;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  padded();
  std::string glb = "glTF";
  put(glb, std::uint32_t(2));
  put(glb, std::uint32_t(28 + text.size() + bytes.size()));
  put(glb, std::uint32_t(text.size()));
  glb += "JSON" + text;
  put(glb, std::uint32_t(bytes.size()));
  return folder.write("box.glb", glb + std::string("BIN\0", 4) + bytes);
}

std::string ply_of(const Box& box, const std::string& format, bool corner_uv) {
  const bool text = format == "ascii", big = format == "binary_big_endian";
  std::string bytes = fmt::format(
      "ply\nformat {} 1.0\ncomment a box\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n{}"
      "element face {}\nproperty list uchar int vertex_indices\n{}end_header\n",
      format, box.point.size(), corner_uv ? "" : "property double s\nproperty double t\n",
      box.triangle.size(), corner_uv ? "property list uchar double texcoord\n" : "");
  const auto add = [&](auto value) {
    if (text) {
      bytes += fmt::format("{} ", value);
      return;
    }
    std::string own;
    put(own, value);
    if (big) std::ranges::reverse(own);
    bytes += own;
  };
  for (std::size_t i = 0; i < box.point.size(); ++i) {
    for (int k = 0; k < 3; ++k) add(box.point[i][k]);
    if (!corner_uv) add(box.uv[i].x), add(box.uv[i].y);
    if (text) bytes += '\n';
  }
  for (const auto& t : box.triangle) {
    add(std::uint8_t(3));
    for (const int i : t) add(std::int32_t(i));
    if (corner_uv) {
      add(std::uint8_t(6));
      for (const int i : t) add(box.uv[std::size_t(i)].x), add(box.uv[std::size_t(i)].y);
    }
    if (text) bytes += '\n';
  }
  return bytes;
}

std::string chunk_of(std::uint16_t type, const std::string& content) {
  std::string bytes;
  put(bytes, type);
  put(bytes, std::uint32_t(content.size() + 6));
  return bytes + content;
}

/// The z axis of 3DS points up. `last` is the last vertex of the last face.
std::string three_ds_of(const Box& box, std::uint16_t last) {
  std::string points, uv, faces;
  put(points, std::uint16_t(box.point.size()));
  for (const glm::dvec3& p : box.point)
    for (const double x : {p.x, -p.z, p.y}) put(points, float(x));
  put(uv, std::uint16_t(box.uv.size()));
  for (const glm::dvec2& p : box.uv)
    for (const double x : {p.x, p.y}) put(uv, float(x));
  put(faces, std::uint16_t(box.triangle.size()));
  for (const auto& t : box.triangle) {
    for (const int i : t) put(faces, std::uint16_t(i));
    put(faces, std::uint16_t(7));
  }
  std::memcpy(&faces[faces.size() - 4], &last, sizeof last);
  const std::string mesh = chunk_of(
      0x4100, chunk_of(0x4110, points) + chunk_of(0x4160, std::string(48, '\0')) + chunk_of(0x4140, uv) +
                  chunk_of(0x4120, faces + chunk_of(0x4150, std::string(48, '\0'))));
  return chunk_of(
      0x4d4d, chunk_of(2, std::string(4, '\3')) +
                  chunk_of(0x3d3d, chunk_of(0xafff, "") + chunk_of(0x4000, std::string("box\0", 4) + mesh)));
}

struct Strangers : test::InFolder {
  std::vector<std::array<double, 5>> plain = corners_of(parse_soup(obj_of(box()), "obj", "box", true));
  std::vector<std::array<double, 5>> without_uv = corners_of(parse_soup(obj_of(box()), "obj", "box"));
  auto corners(const std::string& file, bool with_uv = true) const {
    return corners_of(read_soup(file, with_uv));
  }
};

TEST_F(Strangers, TheSameBoxInEveryFormatHasTheSameSurfaceAndUv) {
  ASSERT_EQ(plain.size(), 36u);
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
    for (const bool corner_uv : {false, true})
      EXPECT_EQ(corners(folder.write("box.ply", ply_of(box(), format, corner_uv))), plain)
          << format << corner_uv;
  EXPECT_EQ(corners(gltf_of(folder, box())), plain);
  EXPECT_EQ(corners(gltf_of(folder, box(), {}, {}, "", "", true)), plain);
  std::string off = "STOFF\n24 12 0\n", stl(80, 's'), text = "solid\n";
  for (std::size_t i = 0; i < 24; ++i)
    off += fmt::format("{} {} {} {} {}\n", box().point[i].x, box().point[i].y, box().point[i].z,
                       box().uv[i].x, box().uv[i].y);
  put(stl, std::uint32_t(12));
  for (const auto& t : box().triangle) {
    off += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    stl += std::string(12, '\0');
    text += "facet normal 0 0 0 outer loop\n";
    for (const int i : t) {
      const glm::dvec3 p = box().point[std::size_t(i)];
      for (int k = 0; k < 3; ++k) put(stl, float(p[k]));
      text += fmt::format("vertex {} {} {}\n", p.x, p.y, p.z);
    }
    stl += std::string(2, '\0');
    text += "endloop endfacet\n";
  }
  EXPECT_EQ(corners(folder.write("box.off", off)), plain);
  EXPECT_EQ(corners(folder.write("box.stl", stl)), without_uv);
  for (const char* count : {"\0\0\0\0", "\xff\xff\xff\xff"}) {
    std::string unknown = stl;
    unknown.replace(80, 4, count, 4);
    EXPECT_EQ(corners(folder.write("box.stl", unknown)), without_uv);
  }
  EXPECT_EQ(corners(folder.write("box.stl", stl + "tail")), without_uv);
  test::expect_has(test::refusal([&] { corners(folder.write("box.stl", stl + std::string(50, '\0'))); }),
                   "12 triangles need 684 bytes, the file has 734");
  const auto last = std::uint16_t(box().triangle.back()[2]);
  EXPECT_EQ(corners(folder.write("box.3ds", three_ds_of(box(), last))), plain);
  test::expect_has(test::refusal([&] { corners(folder.write("box.3ds", three_ds_of(box(), 24))); }),
                   "box.3ds: a face has the vertex 24; there are 24");
  EXPECT_EQ(corners(folder.write("box.stl", text + "endsolid\n")), without_uv);
}

TEST_F(Strangers, ObjMayHaveWeightsColoursAndLongLines) {
  EXPECT_EQ(corners_of(parse_soup(obj_of(box(), "v {} {} {} 1 0.5 0\n"), "obj", "a", true)), plain);
  Box twice = box();
  for (glm::dvec3& p : twice.point) p *= 2;
  EXPECT_EQ(corners_of(parse_soup(obj_of(twice, "v {} {} {} 2\n"), "obj", "a", true)), plain);
  EXPECT_EQ(corners_of(parse_soup(obj_of(box(), "v {} \\\r\n{} \\\r\n {}\r\n"), "obj", "a", true)), plain);
}

TEST_F(Strangers, GltfNumbersMayBeQuantized) {
  const std::string quantized = R"("extensionsRequired":["KHR_mesh_quantization"],)";
  const auto nearly = [&](const std::string& file) {
    const auto found = corners(file);
    ASSERT_EQ(found.size(), plain.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(found[i][k], plain[i][k], 0.003);
  };
  nearly(gltf_of(folder, box(), {}, u16));
  nearly(gltf_of(folder, box(), {}, u8));
  nearly(gltf_of(folder, box(), s16, u16, "", quantized));
  nearly(gltf_of(folder, box(), u16_eighths, {}, R"(,"scale":[0.125,0.125,0.125],"translation":[-1,-1,-1])",
                 quantized));
  test::expect_has(
      test::refusal([&] {
        corners(
            gltf_of(folder, box(), {}, {}, "", R"("extensionsRequired":["KHR_draco_mesh_compression"],)"));
      }),
      "box.gltf: the file requires the extension KHR_draco_mesh_compression, which pelage does not read");
}

TEST_F(Strangers, GltfOfOtherVersionsAndTypesIsRefused) {
  const auto changed = [&](const std::string& from, const std::string& to, bool binary = false) {
    const std::string file = gltf_of(folder, box(), {}, {}, "", "", binary);
    std::string text = test::text_of(file);
    text.replace(text.find(from), from.size(), to);
    folder.write(fs::path(file).filename().string(), text);
    return test::refusal([&] { corners(file); });
  };
  test::expect_has(changed(R"("version":"2.0")", R"("version":"1.0")"),
                   "has the version 1.0; version 2.0 is read");
  test::expect_has(changed(R"("version":"2.0")", R"("version":"2.0","minVersion":"2.7")"), "the version 2.7");
  test::expect_has(changed("glTF\2", "glTF\1", true), "a binary file of version 1; version 2 is read");
  test::expect_has(changed(R"("componentType":5126)", R"("componentType":5124)"),
                   "the component type 5124 is unknown");
}

// The file may be longer than its buffer, and its name has a percent-encoded space and a plus sign.
TEST_F(Strangers, GltfBuffersMayHaveAnyNameAndMoreBytes) {
  const std::string file = gltf_of(folder, box());
  folder.write("a +.bin", folder.read("box.bin") + "more");
  std::string text = test::text_of(file);
  text.replace(text.find("box.bin"), 7, "a%20+.bin");
  EXPECT_EQ(corners(folder.write("box.gltf", text)), plain);
}

TEST_F(Strangers, TextureCoordinatesOfSomeCornersAreRefused) {
  Soup soup = parse_soup(obj_of(box()), "obj", "box", true);
  soup.uv[3].pop_back();
  EXPECT_EQ(test::refusal([&] { check_soup(soup, "box"); }),
            "box: face 3 has 3 corners, but texture coordinates for 2");
}

double volume_of(const Mesh& mesh) {
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangle)
    sum += glm::dot(glm::dvec3(mesh.position[t.x]),
                    glm::cross(glm::dvec3(mesh.position[t.y]), glm::dvec3(mesh.position[t.z]))) /
           6;
  return sum;
}

std::string notes_of(const Mesh& mesh) {
  std::string text;
  for (const std::string& note : mesh.notes) text += note + "\n";
  return text;
}

TEST_F(Strangers, ClosedSurfacesFaceOutwardsWithTheirOwnUvToo) {
  const auto good = load_model(folder.write("box.obj", obj_of(box())), fresh({}, true));
  EXPECT_GT(volume_of(*good), 0);
  test::expect_lacks(notes_of(*good), "turned");
  Box inward = box();
  for (auto& t : inward.triangle) std::swap(t[1], t[2]);
  const auto turned = load_model(folder.write("box.obj", obj_of(inward)), fresh({}, true));
  EXPECT_EQ(turned->hash, good->hash);
  test::expect_has(notes_of(*turned), "turned all faces outwards");
  Box mixed = box();
  std::swap(mixed.triangle[3][0], mixed.triangle[3][1]);
  std::swap(mixed.triangle[8][1], mixed.triangle[8][2]);
  const auto agreed = load_model(folder.write("box.obj", obj_of(mixed)), fresh({}, true));
  EXPECT_EQ(agreed->hash, good->hash);
  test::expect_has(notes_of(*agreed), "turned 2 faces to agree with the neighbours");
  const auto mirrored = load_model(gltf_of(folder, box(), {}, {}, R"(,"scale":[-1,1,1])"), fresh({}, true));
  EXPECT_GT(volume_of(*mirrored), 0);
  test::expect_lacks(notes_of(*mirrored), "turned");
}

TEST_F(Strangers, CornersThatDifferByRoundingAreJoined) {
  Box apart;
  for (const auto& t : box().triangle) {
    const int first = int(apart.point.size());
    for (const int i : t) {
      const double off = 2e-8 * double(apart.point.size());
      apart.point.push_back(box().point[std::size_t(i)] + glm::dvec3(off, -off, off));
      apart.uv.push_back(box().uv[std::size_t(i)]);
    }
    apart.triangle.push_back({first, first + 1, first + 2});
  }
  for (const bool keep : {false, true}) {
    const auto mesh = load_model(folder.write("box.obj", obj_of(apart)), fresh({}, keep));
    const Topology t = topology(*mesh);
    EXPECT_EQ(t.components, 1u);
    EXPECT_EQ(t.points, 8u);
    EXPECT_EQ(t.borders, 0u);
    test::expect_has(notes_of(*mesh),
                     "welded 28 points that differ from others by less than 1e-6 of the mesh's size");
  }
}

TEST_F(Strangers, PolygonsThatAreNotConvexKeepTheirArea) {
  // An L of six corners. The triangles that meet in its first corner would overlap.
  const std::string l =
      "v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nvt 0.5 0\nvt 0.5 0.25\nvt 0.25 0.25\nvt 0.25 0.5\nvt 0 0.5\n"
      "vt 0 0\nf 4/4 5/5 6/6 1/1 2/2 3/3\n";
  const auto mesh = load_model(folder.write("l.obj", l), fresh({}, true));
  double area = 0;
  for (const glm::uvec3& t : mesh->triangle) {
    const glm::dvec2 a = mesh->uv[t.x], b = mesh->uv[t.y], c = mesh->uv[t.z];
    area += 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  }
  EXPECT_NEAR(area, 3.0 / 16, 1e-6);
  EXPECT_EQ(mesh->triangle.size(), 4u);
  EXPECT_TRUE(uv_warnings(*mesh).empty());
}

}  // namespace
}  // namespace pelage
