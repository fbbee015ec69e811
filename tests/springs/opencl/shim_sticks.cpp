#include "tests/springs/opencl/shim.hpp"
// clang-format off: the next header must be the last one, because its macros would break other headers
#include "tests/springs/support/in_double.hpp"
// clang-format on

#define CORNERS 1
#define EDGES 0
namespace pelage::sticks_in_double {
namespace {
using namespace in_double;
// clang-format off
#include "springs/blocks.cl"
// clang-format on
}  // namespace
}  // namespace pelage::sticks_in_double

namespace pelage::springs::test {

BlockKernels stick_kernels() {
  namespace kernels = sticks_in_double;
  return {kernels::explicit_euler_frame, kernels::backward_euler_frame, kernels::semi_implicit_euler_frame,
          kernels::rk4_frame};
}

}  // namespace pelage::springs::test
