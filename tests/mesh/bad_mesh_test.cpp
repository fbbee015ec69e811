// Tests bad mesh files. For each file, load_model() must throw an error with a message of one line. It must
// not crash.
#include <chrono>
#include <sstream>

#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/mesh/soup.hpp"
#include "tests/mesh/mesh_files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

struct Bad {
  std::string name;  ///< name of the test case
  std::string file;  ///< name of the mesh file
  std::string bytes;
  std::string message;  ///< text of the error message after the path
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

const std::string coordinates = "property float x\nproperty float y\nproperty float z\n";

const std::vector<Bad> cases{
    {"empty", "a.obj", "", ": the file is empty"},
    {"unknown_ending", "a.fbx", "x", ": meshes are read from .obj, .off, .ply, .stl, .3ds, .gltf and .glb"},
    {"obj_without_faces", "a.obj", "v 0 0 0\nv 1 0 0\n", ": the file contains no faces"},
    {"obj_nan", "a.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n",
     ":2: found 'nan', but a vertex needs three finite numbers"},
    {"obj_infinity", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 inf 0\nf 1 2 3\n",
     ":3: found 'inf', but a vertex needs three finite numbers"},
    {"obj_overflow", "a.obj", "v 0 0 1e999\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
     ":1: found '1e999', but a vertex needs three finite numbers"},
    {"obj_short_vertex", "a.obj", "v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n",
     ":2: found nothing, but a vertex needs three finite numbers"},
    {"obj_index_out_of_range", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
     ":4: vertex 4 is out of range; there are 3 vertices"},
    {"obj_huge_index", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n",
     ":4: '99999999999999999999' is not a vertex; indices start at 1"},
    {"obj_index_zero", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n",
     ":4: '0' is not a vertex; indices start at 1"},
    {"obj_negative_out_of_range", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n",
     ":4: '-4' is not a vertex; indices start at 1"},
    {"obj_two_corners", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n",
     ":4: a face of 2 corners; give at least three"},
    {"obj_binary", "a.obj", garbage, ": binary data, not OBJ text"},
    {"obj_no_area", "a.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n", ": no face with an area is left"},
    {"off_no_header", "a.off", "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ":1: found '3' instead of OFF"},
    {"off_no_vertices", "a.off", "OFF\n0 0 0\n", ":2: the file contains no faces"},
    {"off_infinity", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 inf\n3 0 1 2\n",
     ":5: found 'inf', but a vertex needs three finite numbers"},
    {"off_truncated_vertices", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n",
     ":4: the file ends before vertex 3 of 3"},
    {"off_truncated_faces", "a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
     ":6: the file ends before face 2 of 2"},
    {"off_huge_counts", "a.off", "OFF\n4000000000 4000000000 0\n0 0 0\n",
     ":2: 4000000000 vertices and 4000000000 faces do not fit into 34 bytes"},
    {"off_bad_index", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n",
     ":6: '7' is not a vertex; give 0 to 2"},
    {"off_bad_number", "a.off", "OFF\n3 1 0\n0 0 zero\n1 0 0\n0 1 0\n3 0 1 2\n",
     ":3: found 'zero', but a vertex needs three finite numbers"},
    {"off_binary", "a.off", "OFF BINARY\n1 1 1\n", ":1: binary OFF is not read; save it as text"},
    {"ply_no_magic", "a.ply", "not a ply file\n", ":1: the line must be 'ply'"},
    {"ply_no_end", "a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", ": the header has no end_header"},
    {"ply_huge_counts", "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 3000000000\nproperty float x\nend_header\n",
     ":3: the number of elements is missing, negative or too large for a file of 75 bytes"},
    {"ply_property_first", "a.ply",
     "ply\nformat ascii 1.0\nproperty float x\nelement vertex 3\nelement face 1\nend_header\n",
     ":3: a property stands before the first element"},
    {"ply_unknown_type", "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty half x\nelement face 1\nend_header\n",
     ":4: the type 'half' is unknown"},
    {"ply_no_coordinate", "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty int y\nelement face 1\nend_header\n",
     ": the vertices have no property y of type float or double"},
    {"ply_no_corners", "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 1\n" + coordinates +
         "element face 1\nproperty list uchar uchar vertex_indices\nend_header\n0 0 0\n3 0 0 0\n",
     ": the faces have no list vertex_indices of type int or uint"},
    {"ply_long_list", "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 1\n" + coordinates +
         "element face 1\nproperty list uint int vertex_indices\nend_header\n0 0 0\n4000000000 0 1 2\n",
     ": face 1: a list of 4000000000 values does not fit into the rest of the file, which has 7 bytes"},
    {"ply_negative_list", "a.ply",
     "ply\nformat binary_big_endian 1.0\nelement vertex 1\n" + coordinates +
         "element face 1\nproperty list short int vertex_indices\nend_header\n" + std::string(12, '\0') +
         "\xff\xff",
     ": face 1: a list of -1 values does not fit into the rest of the file, which has 0 bytes"},
    {"ply_truncated", "a.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n",
     ": vertex 3: the file is truncated"},
    {"stl_short", "a.stl", "short",
     ": the file is not STL text, and it is shorter than the 84 bytes of a binary STL header"},
    {"stl_truncated", "a.stl", binary_stl(1000, 500), ": 1000 triangles need 50084 bytes, the file has 584"},
    {"stl_empty", "a.stl", binary_stl(0, 0), ": the file contains no faces"},
    {"stl_text_truncated", "a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n",
     ":5: the file ends before endsolid"},
    {"stl_text_nan", "a.stl",
     "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 nan 0\nvertex 0 1 0\nendloop\nendfacet\n"
     "endsolid\n",
     ":5: found 'nan', but a vertex needs three finite numbers"},
};

void PrintTo(const Bad& bad, std::ostream* out) {
  *out << bad.name;
}

class BadFile : public testing::TestWithParam<Bad> {};

TEST_P(BadFile, is_refused_in_one_line) {
  const test::Folder folder;
  const std::string file = folder.write(GetParam().file, GetParam().bytes);
  const std::string said = test::refusal([&] { load_model(file, fresh()); });
  EXPECT_EQ(said, file + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(Each, BadFile, testing::ValuesIn(cases),
                         [](const auto& one) { return one.param.name; });

// The text of these errors comes from Assimp, so the test checks only that the message is a single line with
// the file's name.
TEST(BadMesh, garbage_in_formats_that_assimp_reads_is_refused_in_one_line) {
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
  EXPECT_EQ(
      message("torus", fresh(100)),
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
    const auto start = std::chrono::steady_clock::now();
    try {
      const auto mesh = load_model(file, fresh());
      const Topology t = topology(*mesh);
      EXPECT_TRUE(t.manifold()) << name;
      const UvQuality quality = uv_quality(*mesh, 512);
      EXPECT_GE(quality.charts, t.components) << name;
      EXPECT_EQ(quality.flipped, 0.0) << name;
      EXPECT_EQ(quality.overlapping, 0.0) << name;
      all.text(mesh->hash);
      ++prepared;
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_TRUE(what.starts_with(file)) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      test::expect_lacks(what, "crashed");
      std::printf("%s\n", what.c_str());
      all.text(what.substr(file.size()));
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    std::printf("%-36s %.2f s\n", name.c_str(), took.count());
  }
  EXPECT_GE(prepared, files - 3);
  EXPECT_TRUE(!bits_of_cgal || all.hex() == "efbffbc1493f675e") << all.hex();
}

}  // namespace
}  // namespace pelage
