// The kernels of springs/blocks.cl in double precision, as the function KERNELS(). The file that includes this one
// defines KERNELS and the macros that the kernels read.
#include "tests/springs/opencl/shim.hpp"
// clang-format off: the next headers must be the last ones, because their macros would break other headers
#include "tests/springs/support/in_double.hpp"

namespace pelage {
namespace {
using namespace in_double;
#include "springs/blocks.cl"
}  // namespace

springs::test::BlockKernels springs::test::KERNELS() {
  return {explicit_euler_frame, backward_euler_frame, semi_implicit_euler_frame, rk4_frame,
          predictor_corrector_frame};
}

}  // namespace pelage
