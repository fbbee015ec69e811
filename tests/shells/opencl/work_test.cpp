// Counts the floating-point operations of the kernels' functions. Compares the counts with the constants of
// harness/shells/opencl/work.hpp, which docs/machines.md and the roofline plot use.
#include "harness/shells/opencl/work.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "tests/shells/opencl/counting.hpp"

// The kernels are C code, and this file does not use all of their functions. The following lines disable
// GCC's warnings about C constructs and about unused functions.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
namespace pelage::counting {
using std::size_t;
// clang-format off
#include "rasterize/geometry/transform.clh"
#include "rasterize/shading/fragment.clh"
// clang-format on
}  // namespace pelage::counting
#pragma GCC diagnostic pop

namespace pelage {
namespace {

namespace c = counting;
namespace cost = shells::operations;

struct Fragment : ::testing::Test {
  Fragment() {
    s.width = s.height = 64;
    s.layers = 16;
    s.length = 0.08f;
    s.mask_size = 4;
    s.clump_gain = 3.5f;
    s.clump_cells = CELLS_SEPARATE;
    s.log_layers = 2.77f;
    s.fur_size = 4;
    s.fur_levels = 3;
    s.fur_scale[0] = s.fur_scale[1] = 1;
    s.footprint = 1;
    s.substeps = 1;
    s.coat_size = 4;
    s.shadow = 2;
    s.exponent = 24;
    s.whole_exponent = 24;
    s.ambient = 0.3f;
    s.wrap = 0.5f;
    s.lights = 1;
    s.light[0][1] = 1;
    s.light[1][0] = 1;
    s.intensity[0] = s.intensity[1] = 1;
    s.ray[2] = -1;
    std::fill(mask.begin(), mask.end(), 0.0f);
    for (std::size_t i = 0; i < 16; ++i) {
      mask[4 * i] = mask[4 * i + 1] = mask[4 * i + 2] = 0.5f;
      mask[4 * i + 3] = 1;
    }
    p.uv = c::vec2(0.4, 0.4);
    p.a = c::vec3(0.0, 0.0, 1.0);
    p.b = c::vec3(0.1, 0.0, 1.0);
    p.along_u = p.curl_u = c::vec3(1.0, 0.0, 0.0);
    p.along_v = p.curl_v = c::vec3(0.0, 1.0, 0.0);
    p.w = 3.3;
    p.eye = c::eye_through(&s, 2.0, 2.0);
    p.a_square = c::dot3(p.a, p.a);
  }
  c::Textures textures(bool wet) {
    return {fur.data(), coat.data(), wet ? mask.data() : dry.data(), nullptr};
  }
  c::Layer layer() { return c::layer_at(&s, table.data(), 8); }
  double shaded(bool wet) {
    const c::Layer l = layer();
    return c::count([&] { c::fur_fragment(&s, textures(wet), l, c::slice_of(&s, 8), p); });
  }
  double lit() {
    const c::Layer l = layer();
    const c::Fur f = c::fur_fragment(&s, textures(true), l, c::slice_of(&s, 8), p);
    return c::count([&] { c::fur_colour(&s, textures(true), l, p, f); });
  }
  RasterParams s{};
  c::Surface p{};
  std::vector<float> table = std::vector<float>(std::size_t(17) * LAYER_COLUMNS, 0.5f);
  std::vector<std::int32_t> fur = std::vector<std::int32_t>(std::size_t(16) * 64, 0x10203040), coat = fur;
  std::vector<float> mask = std::vector<float>(64), dry = std::vector<float>(64, 0.0f);
};

TEST_F(Fragment, TakesWhatTheRooflineSays) {
  c::expect_near(cost::eye, c::count([&] { c::eye_through(&s, 2.0, 2.0); }), "eye");
  c::expect_near(cost::square, c::count([&] { c::dot3(p.a, p.a); }), "square");
  const double dry_one = shaded(false);
  c::expect_near(cost::dry_fragment, dry_one, "dry fragment");
  c::expect_near(cost::clump, shaded(true) - dry_one, "clump");
  s.clump_cells = CELLS_CONSISTENT;
  s.clump_reading = CLUMP_CONVERGE;
  c::expect_near(cost::consistent_clump, shaded(true) - dry_one, "clump with consistent borders");
  s.clump_cells = CELLS_SEPARATE;
  s.clump_reading = CLUMP_RELATIVE;
  s.substeps = 2;
  const double two = shaded(false);
  s.substeps = 4;
  const double four = shaded(false);
  s.substeps = 1;
  // Each doubling of the number of sub-steps adds the operations of the new sub-steps and one square root.
  // The test does not subtract this square root, because one operation is within the 10% tolerance of
  // expect_near().
  c::expect_near(cost::substep, (four - two) / 2, "substep");
  c::expect_near(cost::substeps, two - dry_one - (four - two) / 2, "substeps");
}

TEST_F(Fragment, IsLitForWhatTheRooflineSays) {
  const double one = lit();
  s.lights = 2;
  const double two = lit();
  c::expect_near(cost::light, two - one, "light");
  c::expect_near(cost::colour, one - (two - one), "colour");
  s.surface_light = 1;
  s.whole_exponent = 0;
  const double wet_two = lit();
  s.lights = 1;
  const double wet_one = lit();
  c::expect_near(cost::wet_light, wet_two - wet_one, "wet light");
  c::expect_near(cost::wet_colour, wet_one - (wet_two - wet_one), "wet colour");
}

TEST_F(Fragment, VerticesTakeWhatTheRooflineSays) {
  s.row_x[0] = s.row_y[1] = s.row_w[2] = 1;
  s.near_depth = 0.1f;
  c::Corner v;
  v.position = v.a = v.b = v.u = v.v = c::vec3(1.0, 1.0, 1.0);
  v.dry = 1;
  const c::Layer l = layer();
  c::expect_near(cost::vertex_layer, c::count([&] { c::to_screen(&s, c::to_clip(&s, l, v)); }),
                 "vertex and layer");
}

TEST(Work, GrowsWithWhatItIsMadeOf) {
  RasterParams raster{};
  raster.vertices = 100;
  raster.layers = 16;
  raster.lights = 2;
  raster.substeps = 1;
  SimulateParams simulate{};
  simulate.stride = 64;
  simulate.substeps = 4;
  shells::Geometry geometry;
  geometry.weight.resize(600);
  const auto one = shells::frame_operations(raster, simulate, geometry, {1000, 500, 100}, 0);
  const auto twice = shells::frame_operations(raster, simulate, geometry, {2000, 1000, 200}, 0);
  EXPECT_DOUBLE_EQ(twice.at("tile_shells"), 2 * one.at("tile_shells"));
  EXPECT_DOUBLE_EQ(one.at("strand_frame"), 64 * 4 * cost::strand_substep);
  EXPECT_DOUBLE_EQ(one.at("vertex_tips"), 3600);
  EXPECT_DOUBLE_EQ(one.at("layer_vertices"), 1700 * cost::vertex_layer);
  EXPECT_GT(shells::frame_operations(raster, simulate, geometry, {1000, 500, 100}, 1).at("tile_shells"),
            one.at("tile_shells"));
}

}  // namespace
}  // namespace pelage
