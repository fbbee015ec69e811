// Counts the floating-point operations of one substep of a strand in the kernels' code
// (simulate/equations.clh). Compares the count with the constant strand_substep of
// harness/shells/opencl/work.hpp.
#include <gtest/gtest.h>

#include "harness/shells/opencl/work.hpp"
#include "tests/shells/opencl/counting.hpp"

namespace pelage::counting {
// clang-format off
#include "simulate/equations.clh"
// clang-format on
}  // namespace pelage::counting

namespace pelage {
namespace {

namespace c = counting;

TEST(StrandStep, TakesWhatTheRooflineSays) {
  SimulateParams s{};
  s.length = 1;
  c::Strand a;
  a.tip = a.speed = c::vec3(0.1, 0.2, 0.3);
  const c::real3 up = c::vec3(0.0, 0.0, 1.0);
  c::expect_near(shells::operations::strand_substep, c::count([&] {
                   const c::real3 f = c::forces(s, a, up, 1.0, 0.0, 0.0, 1.0);
                   c::constrained(s, c::accelerated(s, a, f), up);
                 }),
                 "substep of a strand");
}

}  // namespace
}  // namespace pelage
