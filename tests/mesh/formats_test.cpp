// Tests that the same octahedron or tetrahedron is read from every file format.
#include "harness/mesh/read/formats.hpp"

#include <algorithm>
#include <cstring>

#include "harness/mesh/mesh.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/mesh/steps.hpp"
#include "tests/mesh/mesh_files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

const float corner[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
const int face[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                        {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};

using test::put;

std::string corners(const char* before) {
  std::string text;
  for (const auto& p : corner)
    text += before + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
  return text;
}

std::string faces(const std::string& before, int first) {
  std::string text;
  for (const auto& t : face) {
    text += before;
    for (const int index : t) text.append(" ").append(std::to_string(index + first));
    text.push_back('\n');
  }
  return text;
}

std::string ply(bool binary) {
  std::string bytes = std::string("ply\nformat ") + (binary ? "binary_little_endian" : "ascii") +
                      " 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
                      "element face 8\nproperty list uchar int vertex_indices\nend_header\n";
  if (!binary) return bytes + corners("") + faces("3", 0);
  for (const auto& p : corner)
    for (const float x : p) put(bytes, x);
  for (const auto& t : face) {
    put(bytes, std::uint8_t(3));
    for (const int index : t) put(bytes, index);
  }
  return bytes;
}

std::string stl(bool binary) {
  std::string bytes = binary ? std::string(80, ' ') : "solid octahedron\n";
  if (binary) put(bytes, std::uint32_t(8));
  for (const auto& t : face) {
    if (binary) {
      for (int i = 0; i < 3; ++i) put(bytes, 0.0f);
      for (const int index : t)
        for (const float x : corner[index]) put(bytes, x);
      put(bytes, std::uint16_t(0));
    } else {
      bytes += "facet normal 0 0 0\nouter loop\n";
      for (const int index : t)
        bytes += "vertex " + std::to_string(corner[index][0]) + " " + std::to_string(corner[index][1]) + " " +
                 std::to_string(corner[index][2]) + "\n";
      bytes += "endloop\nendfacet\n";
    }
  }
  return binary ? bytes : bytes + "endsolid octahedron\n";
}

std::string chunk(std::uint16_t id, const std::string& body) {
  std::string bytes;
  put(bytes, id);
  put(bytes, std::uint32_t(body.size() + 6));
  return bytes + body;
}

std::string three_ds() {
  std::string points, triangles;
  put(points, std::uint16_t(6));
  for (const auto& p : corner)
    for (const float x : p) put(points, x);
  put(triangles, std::uint16_t(8));
  for (const auto& t : face) {
    for (const int index : t) put(triangles, std::uint16_t(index));
    put(triangles, std::uint16_t(7));
  }
  const std::string mesh = chunk(0x4100, chunk(0x4110, points) + chunk(0x4120, triangles));
  return chunk(0x4d4d, chunk(0x3d3d, chunk(0x4000, std::string("octa\0", 5) + mesh)));
}

std::string gltf_buffer() {
  std::string buffer;
  for (const auto& p : corner)
    for (const float x : p) put(buffer, x);
  for (const auto& t : face)
    for (const int index : t) put(buffer, std::uint16_t(index));
  return buffer;
}

void expect_octahedron(const std::string& file) {
  const auto mesh = load_model(file, fresh());
  const Topology t = topology(*mesh);
  EXPECT_EQ(t.points, 6u) << file;
  EXPECT_EQ(t.faces, 8u) << file;
  EXPECT_TRUE(t.manifold()) << file;
  EXPECT_TRUE(!bits_of_cgal || mesh->hash == "b599a2fb3f55c215") << file << mesh->hash;
  for (const std::string& note : mesh->notes)
    EXPECT_TRUE(note.starts_with("UV map: one chart, ") || note == "welded 18 coincident points") << note;
}

struct Formats : test::InFolder {};

TEST_F(Formats, every_one_is_read) {
  expect_octahedron(folder.write("octa.obj", "# comment\no octa\n" + corners("v ") + faces("f", 1)));
  expect_octahedron(folder.write("octa.off", "OFF\n6 8 0\n\n" + corners("") + "# comment\n" + faces("3", 0)));
  expect_octahedron(folder.write("ascii.ply", ply(false)));
  expect_octahedron(folder.write("binary.ply", ply(true)));
  expect_octahedron(folder.write("ascii.stl", stl(false)));
  expect_octahedron(folder.write("binary.stl", stl(true)));
  expect_octahedron(folder.write("octa.3ds", three_ds()));
  folder.write("octa.bin", gltf_buffer());
  expect_octahedron(folder.write("octa.gltf", test::gltf_text("octa.bin", 6, 24)));
}

TEST_F(Formats, the_ending_may_be_upper_case_and_obj_may_hold_what_does_not_matter_here) {
  expect_octahedron(folder.write("OCTA.OBJ", "mtllib a.mtl\n" + corners("v ") +
                                                 "vn 0 0 1\nusemtl a\ns off\nl 1 2\n" + "f -6/1/1 3//1 5\n" +
                                                 faces("f", 1).substr(8)));
}

TEST_F(Formats, an_obj_keeps_its_own_map_when_asked_to) {
  const std::string file = folder.write(
      "quad.obj",
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.25 0.25\nvt 0.75 0.25\nvt 0.75 0.5\nvt 0.25 0.5\nf 1/1 2/2 3/3 4/4\nl 1 2\n");
  const auto kept = load_model(file, fresh({}, true));
  EXPECT_EQ(kept->notes, (std::vector<std::string>{"kept the file's own UV map; nothing was repaired"}));
  ASSERT_EQ(kept->uv.size(), 4u);
  for (const glm::vec2 wanted :
       {glm::vec2(0.25f, 0.25f), glm::vec2(0.75f, 0.25f), glm::vec2(0.75f, 0.5f), glm::vec2(0.25f, 0.5f)})
    EXPECT_EQ(std::count(kept->uv.begin(), kept->uv.end(), wanted), 1);
  const auto made = load_model(file, fresh());
  EXPECT_EQ(std::count(made->uv.begin(), made->uv.end(), glm::vec2(0.25f, 0.25f)), 0);
}

TEST_F(Formats, a_file_without_a_map_is_refused_where_its_map_is_asked_for) {
  const auto message = [](const std::string& name) {
    return test::refusal([&] { load_model(name, fresh({}, true)); });
  };
  const std::string wanted =
      " has no UV map of its own, so no UV map can be kept; leave out --keep-uv, or give fur.uv = \"computed\"";
  const std::string off = folder.write("octa.off", "OFF\n6 8 0\n" + corners("") + faces("3", 0));
  EXPECT_EQ(message(off), off + ":" + wanted);
  const std::string obj = folder.write("octa.obj", corners("v ") + faces("f", 1));
  EXPECT_EQ(message(obj), obj + ":" + wanted);
  EXPECT_EQ(message("torus").substr(0, 19), "torus: is no file, ");
}

TEST_F(Formats, a_map_outside_the_unit_square_is_moved_into_it_and_it_is_said) {
  const std::string file = folder.write(
      "quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 3 0\nvt 3 2\nvt 0 2\nf 1/1 2/2 3/3 4/4\n");
  const auto kept = load_model(file, fresh({}, true));
  EXPECT_TRUE(std::any_of(kept->notes.begin(), kept->notes.end(), [](const std::string& note) {
    return note.starts_with("the file's UV map leaves the unit square");
  }));
}

// Each file contains one triangle. The texture coordinates of its corners coincide or lie on a line, so the
// UV map has no area.
TEST_F(Formats, a_map_without_an_area_is_not_kept) {
  for (const char* uv : {"vt 0.5 0.5\nvt 0.5 0.5\nvt 0.5 0.5\n", "vt 0 0\nvt 1 1\nvt 0.25 0.25\n",
                         "vt 5 5\nvt 5 5\nvt 5 5\n", "vt 1e29 0\nvt 1e29 0\nvt 1e29 0\n"}) {
    const std::string file =
        folder.write("a.obj", std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\n") + uv + "f 1/1 2/2 3/3\n");
    const std::string said = test::refusal([&] { load_model(file, fresh({}, true)); });
    EXPECT_EQ(said, file + ": the file's UV map has no area; leave out --keep-uv") << uv;
  }
}

TEST_F(Formats, triangles_without_three_points_are_dropped) {
  Soup soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}}, {{0, 1, 2}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}, {}};
  soup.uv.assign(4, {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)});
  const Surface surface = weld(soup, "a");
  EXPECT_EQ(surface.triangle, (std::vector<Surface::Triangle>{{0, 1, 2}}));
  EXPECT_EQ(surface.notes, (std::vector<std::string>{"kept the file's own UV map; nothing was repaired",
                                                     "coincident or unused points left out: 1",
                                                     "dropped 3 degenerate faces"}));
  EXPECT_EQ(surface.point.size(), 3u);
}

using Points = std::vector<glm::dvec3>;
using Polygons = std::vector<std::vector<std::uint32_t>>;

TEST_F(Formats, hold_much_that_does_not_matter_here) {
  const Points points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const std::string word : {"OFF", "COFF", "NOFF", "CNOFF"}) {
    const Soup soup =
        parse_soup(word + " # a\n\n3\t2 0\n0 0 0 255 0 9\n1 0 0 1\n0 1\t0\r\n3 0 1 2 0.5\n1 0\n", "off", "a");
    EXPECT_EQ(soup.point, points);
    EXPECT_EQ(soup.polygon, (Polygons{{0, 1, 2}, {0}}));
  }
  const Soup obj =
      parse_soup("V 0 0 0# a\rvn 0 0 1\nv 1\t0 0 1 0 0\r\nv 0 \\\n 4 0 4\nf\t-3/1\v2//1 +3 \n", "obj", "a");
  EXPECT_EQ(obj.point, points);
  EXPECT_EQ(obj.polygon, (Polygons{{0, 1, 2}}));
  const std::string solid = "solid facet" + std::string(69, ' ') + '\1' + std::string(53, '\0');  // is binary
  EXPECT_EQ(detail::read_stl(solid, "a").polygon.size(), 1u);
  EXPECT_EQ(parse_soup("SOLID vertex\nFACET normal nan 0 0 OUTER LOOP VERTEX 0 0 0 vertex 1 0 0\n"
                       "vertex 0 1 0 vertex 2 2 0 endloop endfacet\nendsolid vertex",
                       "stl", "a")
                .polygon,
            (Polygons{{0, 1, 2, 3}}));
  EXPECT_EQ(parse_soup("OFF 3 1 0 0 0 0 1 0 0 0 1 0 3 0 1 2", "off", "a").point, points);
}

std::string ply_with(const std::string& format, const std::string& elements, const std::string& values) {
  return "ply\nformat " + format + " 1.0\nelement vertex 1\n" + elements + "end_header\n" + values;
}

TEST_F(Formats, ply_has_properties_of_every_type) {
  const std::string all =
      "property int8 a\nproperty float32 x\nproperty uchar b\nproperty double y\nproperty short c\n"
      "property uint16 d\nproperty float z\nproperty int e\nproperty uint f\nproperty list char uchar g\n"
      "property list ushort uchar h\nelement edge 1\nproperty int i\n"
      "element face 1\nproperty list uint8 int32 vertex_index\nproperty uchar j\n";
  const Soup text = detail::read_ply(
      ply_with("ascii", all,
               "-128 0.5 0 1 -32768 65535 2e3 -2147483648 4294967295 2 7 7 0\n9\n3 0 0 0 255\n"),
      "a", false);
  EXPECT_EQ(text.point, (Points{{0.5, 1, 2000}}));
  EXPECT_EQ(text.polygon, (Polygons{{0, 0, 0}}));
  const auto bytes = [](auto value, bool big) {
    std::string text_of(sizeof value, ' ');
    std::memcpy(text_of.data(), &value, sizeof value);
    if (big) std::reverse(text_of.begin(), text_of.end());
    return text_of;
  };
  for (const bool big : {false, true}) {
    const auto put = [&](auto value) { return bytes(value, big); };
    const Soup binary =
        detail::read_ply(ply_with(big ? "binary_big_endian" : "binary_little_endian", all,
                                  "a" + put(0.5f) + "b" + put(1.0) + "ccdd" + put(2000.0f) + "eeeeffff@" +
                                      std::string(64, 'g') + put(std::uint16_t(258)) + std::string(258, 'h') +
                                      "iiii\3" + put(0) + put(0) + put(0) + "j"),
                         "a", false);
    EXPECT_EQ(binary.point, text.point);
    EXPECT_EQ(binary.polygon, text.polygon);
  }
}

TEST_F(Formats, ply_has_strips_and_uv_of_vertices_or_of_corners) {
  const std::string
      four =
          "ply\rformat ascii 1.0\relement vertex 4\rproperty int x\rproperty int y\rproperty int z\rproperty float u\r"
          "property float v\r",
      points = "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n1 1 0 1 1\n";
  const Soup strips =
      parse_soup(four + "element tristrips 1\rproperty list int int vertex_indices\rend_header\r" + points +
                     "9 0 1 2 3 -1 3 1 0 -1\n",
                 "ply", "a", true);
  EXPECT_EQ(strips.polygon, (Polygons{{0, 1, 2}, {1, 3, 2}, {3, 1, 0}}));
  EXPECT_EQ(strips.uv.at(1).at(1), glm::dvec2(1, 1));
  const Soup wedge = parse_soup(four +
                                    "element face 1\rproperty list uchar ushort vertex_indices\r"
                                    "property list uchar float texcoord\rend_header\r" +
                                    points + "3 0 1 2 6 0.25 0 0.5 0 0.25 0.75\n",
                                "ply", "a", true);
  EXPECT_EQ(wedge.uv, (std::vector<std::vector<glm::dvec2>>{{{0.25, 0}, {0.5, 0}, {0.25, 0.75}}}));
}

TEST_F(Formats, what_can_be_repaired_is_and_it_is_said) {
  // The file has two components. The larger one has a flipped face, a missing face and a duplicate face.
  std::string text = corners("v ") + faces("f", 1);
  text.replace(text.find("f 1 3 5"), 7, "f 3 1 5");
  text.erase(text.rfind("f "));
  text += "f 2 4 5\nv 5 5 5\nv 6 5 5\nv 5 6 5\nf 7 8 9\n";
  std::string said;
  MeshOptions options = fresh();
  options.largest_only = true;
  options.progress = [&](const std::string& line) { said.append(line).push_back('\n'); };
  const auto mesh = load_model(folder.write("broken.obj", text), options);
  EXPECT_EQ(mesh->triangle.size(), 7u);
  const Topology t = topology(*mesh);
  EXPECT_TRUE(t.manifold());
  EXPECT_EQ(t.components, 1u);
  test::expect_has(said, {"dropped 1 degenerate or doubled face", "kept the largest of 2 components",
                          "left 1 border open"});
}

}  // namespace
}  // namespace pelage
