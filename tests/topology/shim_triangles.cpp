#include "tests/topology/shim.hpp"
// clang-format off: it defines words that no header after it would survive
#include "tests/topology/in_double.hpp"
// clang-format on

#define CORNERS 3
#define EDGES 1
namespace pelage::triangles_in_double {
namespace {
using namespace in_double;
// clang-format off
#include "topology/blocks.cl"
// clang-format on
}  // namespace
}  // namespace pelage::triangles_in_double

namespace pelage::springs::test {

void launch_triangles(Solver solver, Memory& m) {
  namespace kernels = triangles_in_double;
  const auto kernel = solver == Solver::explicit_euler        ? kernels::explicit_euler_frame
                      : solver == Solver::semi_implicit_euler ? kernels::semi_implicit_euler_frame
                      : solver == Solver::rk4                 ? kernels::rk4_frame
                                                              : kernels::backward_euler_frame;
  for (in_double::work_item = 0; in_double::work_item < 16 * m.params.blocks; ++in_double::work_item)
    kernel(m.params, m.moments.data(), m.sites.data(), m.push.data(), m.sides.data(), m.offset.data(),
           m.speed.data(), m.diverged_at.data(), m.first.data());
}

}  // namespace pelage::springs::test
