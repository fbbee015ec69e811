// Tests bad mesh files. For each file, load_model() must throw an error with a message of one line. It must
// not crash.
#include <sstream>

#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/mesh/read/soup.hpp"
#include "tests/mesh/mesh_files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

struct Bad {
  std::string ending, bytes;  ///< of the mesh file
  std::string message;        ///< after the path
};

std::string binary_stl(std::uint32_t triangles, std::size_t bytes) {
  std::string text(80, ' ');
  text.append(reinterpret_cast<const char*>(&triangles), 4);
  return text + std::string(bytes, '\1');
}

const std::string garbage = [] {
  std::string bytes;
  std::uint32_t state = 12345;
  for (int i = 0; i < 5000; ++i) bytes.push_back(char((state = state * 1664525 + 1013904223) >> 24));
  return bytes;
}();

const std::string obj_points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n",
                  off_points = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
const std::string no_numbers = ", but a vertex needs three numbers from -1e+30 to 1e+30";
const std::string ply_text = "ply\nformat ascii 1.0\n", ply_vertex = "element vertex 1\n";
const std::string coordinates = "property float x\nproperty float y\nproperty float z\n";
const std::string ply_face = "element face 1\nproperty list uchar int vertex_indices\n",
                  ply_end = "end_header\n";
const std::string no_corners = ": the list vertex_indices must have whole numbers";
const std::string no_count = ":3: the number of elements is missing, negative or too large for a file of ";
const std::string stl_facet = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n";

const std::vector<Bad> cases{
    {"obj", "", ": the file is empty"},
    {"fbx", "x", ": meshes are read from .obj, .off, .ply, .stl, .3ds, .gltf and .glb"},
    {"obj", "v 0 0 0\nv 1 0 0\n", ": the file contains no faces"},
    {"obj", "# nothing", ": the file contains no faces"},
    {"obj", "v 0 0 0\nv nan 0 0\n", ":2: found 'nan'" + no_numbers},
    {"obj", "v 0 0 0\nv 1 0 0\nv 0 inf 0\n", ":3: found 'inf'" + no_numbers},
    {"obj", "v 0 0 1e999\n", ":1: found '1e999'" + no_numbers},
    {"obj", "v 0 0 -1.1e30\n", ":1: found '-1.1e30'" + no_numbers},
    {"obj", "v 0 0 ~1\x01\n", ":1: found '~1?'" + no_numbers},
    {"obj", "v 0 0 0\nv 1 0\n", ":2: found nothing" + no_numbers},
    {"obj", obj_points + "f 1 2 4\nf 1 3 4\n", ":4: vertex 4 is out of range; there are 3 vertices"},
    {"obj", obj_points + "f 1 2 " + std::string(25, '9') + "\n",
     ":4: '" + std::string(24, '9') + "' is not a vertex; indices start at 1"},
    {"obj", obj_points + "f 0 1 2\n", ":4: '0' is not a vertex; indices start at 1"},
    {"obj", obj_points + "f -1 -2 -4\n", ":4: '-4' is not a vertex; indices start at 1"},
    {"obj", obj_points + "f 1 2\n", ":4: a face of 2 corners; give at least three"},
    {"obj", garbage, ": binary data, not OBJ text"},
    {"obj", "\xff\xfev", ": UTF-16 text, which is not read; save the file as UTF-8"},
    {"obj", "v 1 2 3 0\n", ":1: the weight of a vertex is 0"},
    {"off", "OFF 3 1 0 0 0 0 1 0 0 0 1 0 3 0 1 2 255", ":1: words remain after the last face"},
    {"off", "4OFF\n", ":1: '4OFF': only OFF with the prefixes ST, C and N is read"},
    {"obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 1\n", ": no face with an area is left"},
    {"obj", "v 0 0 0\nv 1e-31 0 0\nv 0 1e-31 0\nf 1 2 3\n", ": the surface is smaller than 1e-30"},
    {"off", "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ":1: found '3' instead of OFF"},
    {"off", "OFF\n0 1 0\n1 0\n", ":2: the file contains no faces"},
    {"off", "OFF\n1 0 0\n0 0 0\n", ":2: the file contains no faces"},
    {"off", "OFF\n1\n0 0 0\n", ":2: the counts of vertices and faces are missing or invalid"},
    {"off", "OFF\n-1 1 0\n", ":2: the counts of vertices and faces are missing or invalid"},
    {"off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 inf\n3 0 1 2\n", ":5: found 'inf'" + no_numbers},
    {"off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", ":4: the file ends before vertex 3 of 3"},
    {"off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ":6: the file ends before face 2 of 2"},
    {"off", "OFF\n4000000000 4000000000 0\n0 0 0\n",
     ":2: 4000000000 vertices and 4000000000 faces do not fit into 34 bytes"},
    {"off", "OFF\n8 5 0\n0 0 0\n0 0 0\n0 0 0.0\n", ":2: 8 vertices and 5 faces do not fit into 30 bytes"},
    {"off", "OFF\n7 6 0\n0 0 0\n0 0 0\n0 0 0.0\n", ":2: 7 vertices and 6 faces do not fit into 30 bytes"},
    {"off", "OFF\n7 5 0\n0 0 0\n0 0 0\n0 0 0.0\n", ":5: the file ends before vertex 4 of 7"},
    {"off", off_points + "3 0 1 3\n", ":6: '3' is not a vertex; give 0 to 2"},
    {"off", off_points + "3 0 1 -1\n", ":6: '-1' is not a vertex; give 0 to 2"},
    {"off", off_points + "0\n", ":6: a face cannot have '0' corners; give a whole number of at least 1"},
    {"off", "OFF\n3 1 0\n0 0 0x1\n1 0 0\n0 1 0\n3 0 1 2\n", ":3: found '0x1'" + no_numbers},
    {"off", "OFF BINARY\n1 1 1\n", ":1: binary OFF is not read; save it as text"},
    {"ply", "not a ply file\n", ":1: the line must be 'ply'"},
    {"ply", "ply\nformat ascii\n" + ply_vertex, ":2: the line must be 'format ascii 1.0' or a binary format"},
    {"ply", ply_text + ply_vertex, ": the header has no end_header"},
    {"ply", ply_text + "element vertex 3000000000\nproperty float x\nend_header\n", no_count + "75 bytes"},
    {"ply", ply_text + "element vertex\n", no_count + "36 bytes"},
    {"ply", ply_text + "element vertex -1\n", no_count + "39 bytes"},
    {"ply", ply_text + "property float x\n" + ply_vertex, ":3: a property stands before the first element"},
    {"ply", ply_text + ply_vertex + "property half x\n", ":4: the type 'half' is unknown"},
    {"ply", ply_text + ply_vertex + "property float x\nproperty int z\n" + ply_face + ply_end,
     ": the vertices have no property y that is a number"},
    {"ply", ply_text + ply_vertex + "property list uchar float x\n" + ply_face + ply_end,
     ": the vertices have no property x that is a number"},
    {"ply", ply_text + ply_vertex + coordinates + ply_face + ply_end + "1 0 1.1e30\n3 0 0 0\n",
     ": the coordinates of vertex 0 must be numbers from -1e+30 to 1e+30"},
    {"ply", ply_text + ply_vertex + ply_vertex + ply_face + ply_end, ": two elements have the name vertex"},
    {"ply", ply_text + ply_vertex + coordinates + ply_end, ": the file contains no faces"},
    {"ply", ply_text + ply_vertex + coordinates + "element face 0\n" + ply_end,
     ": the file contains no faces"},
    {"ply",
     ply_text + ply_vertex + coordinates + "element face 1\nproperty list uchar int corners\n" + ply_end,
     ": the element face has no list vertex_indices"},
    {"ply",
     ply_text + ply_vertex + coordinates + "element face 1\nproperty list uchar float vertex_indices\n" +
         ply_end,
     no_corners},
    {"ply", ply_text + ply_vertex + coordinates + ply_face + ply_end + "0 0 0\n3 0 x 0\n",
     ": face 1: found 'x', but the value must be a int"},
    {"ply",
     ply_text + "element abcdefghijklmnopqrstuvwxyz 1\nproperty char a\n" + ply_vertex + coordinates +
         ply_face + ply_end + "-129",
     ": abcdefghijklmnopqrst 1: found '-129', but the value must be a char"},
    {"ply",
     ply_text + ply_vertex + coordinates + "element face 1\nproperty list uint int vertex_indices\n" +
         ply_end + "0 0 0\n4000000000 0 1 2\n",
     ": face 1: a list of 4000000000 values does not fit into the rest of the file, which has 7 bytes"},
    {"ply",
     "ply\nformat binary_big_endian 1.0\n" + ply_vertex + coordinates +
         "element face 1\nproperty list short int vertex_indices\n" + ply_end + std::string(12, '\0') +
         "\xff\xff",
     ": face 1: a list of -1 values does not fit into the rest of the file, which has 0 bytes"},
    {"ply", ply_text + "element vertex 3\n" + coordinates + ply_face + ply_end + "0 0 0\n1 0 0\n",
     ": vertex 3: the file is truncated"},
    {"stl", "short",
     ": the file is not STL text, and it is shorter than the 84 bytes of a binary STL header"},
    {"stl", binary_stl(1000, 500), ": 1000 triangles need 50084 bytes, the file has 584"},
    {"stl", binary_stl(0, 0), ": the file contains no faces"},
    {"stl", stl_facet + "vertex 1 0 0\n", ":5: the file ends before endsolid"},
    {"stl", stl_facet + "vertex 1 nan 0\n", ":5: found 'nan'" + no_numbers},
};

// Texture coordinates are checked if they are used.
TEST(BadFile, errors_of_texture_coordinates_are_refused_where_they_are_used) {
  const test::Folder folder;
  const std::string face = "f 1/1 2/2 3/3\n", good = "vt 0 0\nvt 1 0\n";
  const std::vector<std::pair<std::string, std::string>> files{
      {good + "vt nan 1\n" + face, ":6: found 'nan', but a texture coordinate needs numbers"},
      {good + "vt 0,5 1\n" + face, ":6: found '0,5', but a texture coordinate needs numbers"},
      {good + face, ":6: texture coordinate 3 is out of range; there are 2 texture coordinates"},
      {good + "vt 0 1\nf 1/1 2/0 3/3\n", ":7: '0' is not a texture coordinate; indices start at 1"},
      {good + "vt 0 1\nf 1/1 2 3/3\n", ":7: only some corners of the face have texture coordinates"},
      {good + "vt 0 1\n" + face + "f 1 3 2\n",
       ": 1 of 2 faces have no texture coordinates; give them some, or leave out --keep-uv"}};
  for (const auto& [text, message] : files) {
    const std::string file = folder.write("a.obj", obj_points + text);
    EXPECT_EQ(test::refusal([&] { load_model(file, fresh({}, true)); }), file + message);
  }
}

TEST(BadFile, is_refused_in_one_line) {
  const test::Folder folder;
  for (const Bad& bad : cases) {
    const std::string file = folder.write("a." + bad.ending, bad.bytes);
    EXPECT_EQ(test::refusal([&] { load_model(file, fresh()); }), file + bad.message) << bad.bytes;
  }
}

// The text of these errors comes from tinygltf, so the test checks only that the message is a
// single line with the file's name.
TEST(BadMesh, garbage_in_formats_that_libraries_read_is_refused_in_one_line) {
  const test::Folder folder;
  for (const char* name : {"a.3ds", "a.gltf", "a.glb"}) {
    for (const std::string& bytes :
         {garbage, std::string("{\"asset\": {\"version\": \"2.0\"}, \"meshes\": 7}"),
          std::string("glTF\2\0\0\0\xff\xff\xff\x7f", 12), std::string(3000, '\0')}) {
      const std::string file = folder.write(name, bytes);
      const std::string what = test::refusal([&] { load_model(file, fresh()); });
      EXPECT_TRUE(what.starts_with(file)) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
  }
}

TEST(BadMesh, what_is_no_file_is_said_so) {
  const test::Folder folder;
  const auto message = [](const std::string& name, const MeshOptions& options = {}) {
    return test::refusal([&] { load_model(name, options); });
  };
  EXPECT_TRUE(message("no-such-model")
                  .starts_with("no-such-model: neither a file nor a model; the models are torus, pear,"));
  EXPECT_EQ(message(folder.path.string()), folder.path.string() + ": not a file");
  EXPECT_EQ(message("bunny", fresh(0)), "the number of faces is 0; give 4 to 8000000");
  EXPECT_EQ(message("bunny", fresh(4'000'000'000u)), "the number of faces is 4000000000; give 4 to 8000000");
  for (const std::uint32_t faces : {4u, 8'000'000u})
    EXPECT_EQ(
        message("torus", fresh(faces)),
        "torus: has 9360 faces and a UV map of its own; the face count cannot change while that map is kept");
}

const std::string nasty =
    "ALSTOM_TEST4 P cheese-box corner_tris_with_hole cross_quad cube-ouvert cube_poly degtri_sliding double-torus-3-holes fold handle hedra_open hole in mech-holes-shark mesh_with_colors patch-01 pinion_small plane prim pyramid quad quads_to_stitch quint_tris reference_tetrahedron star tet-shuffled tetra_intersected_by_triangle triangle triangular_hole u";

// All faulty meshes of CGAL's examples: load_model() prepares each mesh, or throws an error of one line. A
// change that changes the meshes on purpose writes the new hash here.
TEST(NastyMesh, is_prepared_or_refused_and_never_crashes) {
  const test::Folder folder;
  std::size_t prepared = 0, files = 0;
  Hash all;
  std::istringstream names(nasty);
  for (std::string name; names >> name; ++files) {
    const auto bytes = read_member("/usr/share/doc/libcgal-dev/data.tar.gz", "data/meshes/" + name + ".off");
    ASSERT_TRUE(bytes) << name;
    const std::string file = folder.write(name + ".off", *bytes);
    try {
      const auto mesh = load_model(file, fresh());
      const Topology t = topology(*mesh);
      EXPECT_TRUE(t.manifold()) << name;
      const UvQuality quality = uv_quality(*mesh, 512);
      EXPECT_GE(quality.charts, t.components) << name;
      EXPECT_EQ(quality.flipped, 0.0) << name;
      EXPECT_EQ(quality.overlapping, 0.0) << name;
      all.text(mesh->hash);
      for (const std::string& note : mesh->notes) all.text(note);
      ++prepared;
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_TRUE(what.starts_with(file)) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      test::expect_lacks(what, "crashed");
      all.text(what.substr(file.size()));
    }
  }
  EXPECT_GE(prepared, files - 3);
  EXPECT_TRUE(!bits_of_cgal || all.hex() == "cef6af4c5efe3327") << all.hex();
}

}  // namespace
}  // namespace pelage
