#include "tests/springs/opencl/shim.hpp"
// clang-format off: the next header must be the last one, because its macros would break other headers
#include "tests/springs/support/in_double.hpp"
// clang-format on

#define CORNERS 1
#define EDGES 0
#define FULL_JACOBIAN 1
namespace pelage::full_sticks_in_double {
namespace {
using namespace in_double;
// clang-format off
#include "springs/blocks.cl"
// clang-format on
}  // namespace
}  // namespace pelage::full_sticks_in_double

namespace pelage::springs::test {

BlockKernels full_stick_kernels() {
  namespace kernels = full_sticks_in_double;
  return {kernels::explicit_euler_frame, kernels::backward_euler_frame, kernels::semi_implicit_euler_frame,
          kernels::rk4_frame};
}

}  // namespace pelage::springs::test
