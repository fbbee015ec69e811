// Loads all faulty meshes of CGAL's examples. load_model() must prepare each mesh or throw an error with a
// message of one line. It must not crash.
#include <gtest/gtest.h>

#include <chrono>

#include "harness/error.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/mesh/soup.hpp"
#include "tests/mesh/temp_folder.hpp"

namespace pelage {
namespace {

const char* const files[] = {"ALSTOM_TEST4.off",
                             "P.off",
                             "cheese-box.off",
                             "corner_tris_with_hole.off",
                             "cross_quad.off",
                             "cube-ouvert.off",
                             "cube_poly.off",
                             "degtri_sliding.off",
                             "double-torus-3-holes.off",
                             "fold.off",
                             "handle.off",
                             "hedra_open.off",
                             "hole.off",
                             "in.off",
                             "mech-holes-shark.off",
                             "mesh_with_colors.off",
                             "patch-01.off",
                             "pinion_small.off",
                             "plane.off",
                             "prim.off",
                             "pyramid.off",
                             "quad.off",
                             "quads_to_stitch.off",
                             "quint_tris.off",
                             "reference_tetrahedron.off",
                             "star.off",
                             "tet-shuffled.off",
                             "tetra_intersected_by_triangle.off",
                             "triangle.off",
                             "triangular_hole.off",
                             "u.off"};

TEST(NastyMesh, is_prepared_or_refused_and_never_crashes) {
  const TempFolder folder;
  std::size_t prepared = 0;
  for (const char* name : files) {
    const auto bytes =
        read_member("/usr/share/doc/libcgal-dev/data.tar.gz", std::string("data/meshes/") + name);
    ASSERT_TRUE(bytes) << name;
    const std::string file = folder.write(name, *bytes);
    const auto start = std::chrono::steady_clock::now();
    try {
      const auto mesh = load_model(file, fresh());
      const Topology t = topology(*mesh);
      EXPECT_TRUE(t.manifold()) << name;
      const UvQuality quality = uv_quality(*mesh, 512);
      EXPECT_GE(quality.charts, t.components) << name;
      EXPECT_EQ(quality.flipped, 0.0) << name;
      EXPECT_EQ(quality.overlapping, 0.0) << name;
      ++prepared;
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_TRUE(what.starts_with(file)) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      EXPECT_EQ(what.find("crashed"), std::string::npos) << what;
      std::printf("%s\n", what.c_str());
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    std::printf("%-36s %.2f s\n", name, took.count());
  }
  EXPECT_GE(prepared, std::size(files) - 3);
}

}  // namespace
}  // namespace pelage
