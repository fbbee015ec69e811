// Counts the floating-point operations of the kernels' functions for strands. Compares the counts with the
// constants of harness/strands/opencl/work.hpp, which the roofline uses.
#define STRAND_SHADOW 2  // the kernels read the opacity map as SHADOW_EXPONENTIAL
#include "harness/strands/opencl/work.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "kernels/strands/chain/params.h"
#include "kernels/strands/draw/params.h"
#include "tests/shells/opencl/counting.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#ifdef __clang__
#pragma clang diagnostic ignored "-Wbitwise-instead-of-logical"
#endif
namespace pelage::counting {
using std::size_t;
// clang-format off
#include "strands/draw/strip.clh"
#include "strands/draw/fills.clh"
#include "strands/chain/step.clh"
// clang-format on
}  // namespace pelage::counting
#pragma GCC diagnostic pop

namespace pelage::strands {
namespace {

namespace c = counting;
namespace cost = operations;

DrawParams params() {
  DrawParams p{};
  p.row_x[0] = p.row_y[1] = p.row_w[2] = 1;
  p.row_w[3] = 3;
  p.near_depth = 0.1f;
  p.pixel = 0.002f;
  p.segments = 6;
  p.taper = 0.8f;
  p.opacity = 0.9f;
  p.light[1] = -1;
  p.intensity = 1;
  p.whole_exponent = 40;
  p.exponent = 40;
  p.map_size = 4;
  p.rim_exponent = 3;
  return p;
}

c::Row row() {
  c::Row r{};
  r.root = c::vec3(0.0, 0.0, 3.0);
  r.joint = c::vec3(0.1, 0.1, 3.0);
  r.tip = c::vec3(0.2, 0.1, 3.0);
  r.radius = 0.01;
  r.colour = c::vec3(0.5, 0.5, 0.5);
  r.joint_height = 0.5;
  r.tip_height = 1;
  r.steady = c::vec3(0.1, 0.1, 0.1);
  return r;
}

TEST(StrandWork, CurvesTakeWhatTheRooflineSays) {
  const DrawParams p = params();
  c::Key key{};
  key.root = c::vec3(0.0, 0.0, 0.0);
  key.normal = c::vec3(0.0, 0.0, -1.0);
  key.u = key.w = key.rest = c::vec3(0.6, 0.0, -0.8);
  c::Key between{};
  const double interpolated = c::count([&] {
    between = c::above_skin(c::between_keys(key, key, key, 0.3, 0.3), 1.0);
    const c::Curve curve = c::curve_of(between, 0.1, 0.5);
    c::in_view(&p, curve.root), c::in_view(&p, curve.joint), c::in_view(&p, curve.tip);
  });
  // Culling and the blocks of a strand (is_seen() and blocks_of() in keys.cl) take about 60 more.
  c::expect_near(cost::between_keys, interpolated + 60, "interpolation");
  const c::Turn turn{0.8, 0.6};
  c::expect_near(cost::style, c::count([&] { c::styled(between, 0.5, turn, turn); }), "style");
  const float fills[9] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
  const double lights = c::count([&] {
    for (int colour = 0; colour < 3; ++colour) c::fill_light(fills, key.normal);
    c::power(0.5, 3.0);
  });
  // Normalizing the direction from the eye, rim and heights take about 50 more (steady_light() in keys.cl).
  c::expect_near(cost::steady_light, lights + 50, "steady light");
}

TEST(StrandWork, VerticesTakeWhatTheRooflineSays) {
  const DrawParams p = params();
  const std::vector<float> map(64, 0.5f);
  const std::vector<std::int32_t> film(16, 0x00808080);
  const c::real3 from_eye = c::towards_joint(&p, row());
  const double all = c::count([&] { c::vertex_at(&p, film.data(), map.data(), row(), from_eye, 0.4); });
  const double shadow = c::count([&] { c::key_light(&p, map.data(), c::vec3(0.0, 0.0, 3.0)); });
  c::expect_near(cost::shadow, shadow, "shadow");
  c::expect_near(cost::lit_vertex, all - shadow, "lit vertex");
  // Film strip (12), shadow of the skin (14) and the light that does not change (9).
  c::expect_near(cost::vertex, all - shadow - 35, "vertex");
}

TEST(StrandWork, StepsTakeWhatTheRooflineSays) {
  ChainParams p{};
  p.first = p.second = 0.5f;
  p.inertia_first = 0.25f;
  p.inertia_second = p.inertia_both = 0.1f;
  p.lever_first = 0.5f;
  p.lever_second = 0.2f;
  p.damping_first = p.damping_second = 1;
  p.step = 1 / 240.0f;
  c::Hold hold{};
  hold.rest = hold.normal = c::vec3(0.0, 1.0, 0.0);
  hold.stiff_first = 800;
  hold.stiff_second = 400;
  hold.limit_first = hold.limit_second = 0.2;
  hold.theta = 0.7;
  hold.beyond = 0.4;
  c::Chain chain{};
  chain.u = chain.w = c::vec3(0.28, 0.96, 0.0);
  chain.a = chain.b = c::vec3(0.0, 0.0, 0.0);
  const ChainMoment moment{};
  const double taken = c::count([&] {
    hold.rest = c::in_world(moment, c::vec3(0.0, 1.0, 0.0));
    hold.normal = c::in_world(moment, c::vec3(0.0, 1.0, 0.0));
    const c::Pull g = c::pull_on(p, moment, c::vec3(0.0, 1.0, 0.0), 10.0, 1.0, 0.0);
    hold.rest = hold.normal = c::vec3(0.0, 1.0, 0.0);
    bool deferred = false;
    c::stepped(p, hold, g, chain, 1, &deferred);
    EXPECT_FALSE(deferred);
  });
  c::expect_near(cost::chain_step, taken, "step of a chain");
}

TEST(StrandWork, GrowsWithWhatItIsMadeOf) {
  StrandWork one;
  one.keys = 10;
  one.substeps = 4;
  one.strands = 1000;
  one.listed = 600;
  one.fragments = 5000;
  one.segments = 6;
  StrandWork other = one;
  other.fragments = 6000;
  const PhaseKernel raster{"raster", "strand_tiles"}, keys{"keys", "strand_keys"};
  const auto a = frame_operations(one), b = frame_operations(other);
  EXPECT_DOUBLE_EQ(b.at(raster) - a.at(raster), 1000 * cost::fragment);
  EXPECT_DOUBLE_EQ(a.at({"simulate", "chain_frame"}), 40 * cost::chain_step);
  EXPECT_FALSE(a.contains({"shadow", "strand_keys"}));
  other.shadow = other.lights = other.styles = true;
  other.drawn = 500;
  other.map_listed = 900;
  other.skin_vertices = 70;
  other.skin_pixels = 40;
  const auto full = frame_operations(other);
  EXPECT_DOUBLE_EQ(full.at(keys), 1000 * (cost::between_keys + cost::style) + 500 * cost::steady_light);
  EXPECT_GT(full.at({"shadow", "strand_tiles"}), 0);
  EXPECT_DOUBLE_EQ(full.at({"skin", "skin_owner"}), 40 * cost::skin_pixel);
  EXPECT_DOUBLE_EQ(full.at({"skin", "skin_vertices"}), 70 * (cost::skin_vertex + cost::shadow));
}

}  // namespace
}  // namespace pelage::strands
