#include "tests/springs/opencl/shim.hpp"
// clang-format off: the next header must be the last one, because its macros would break other headers
#include "tests/springs/support/in_double.hpp"
// clang-format on

namespace pelage::springs::test {

void launch_blocks(const BlockKernels& kernels, Solver solver, Memory& m) {
  const BlockKernel kernel = solver == Solver::explicit_euler        ? kernels.explicit_euler
                             : solver == Solver::semi_implicit_euler ? kernels.semi_implicit_euler
                             : solver == Solver::rk4                 ? kernels.rk4
                             : solver == Solver::predictor_corrector ? kernels.predictor_corrector
                                                                     : kernels.backward_euler;
  for (in_double::work_item = 0; in_double::work_item < 16 * m.params.blocks; ++in_double::work_item)
    kernel(m.params, m.moments.data(), m.sites.data(), m.push.data(), m.sides.data(), m.offset.data(),
           m.speed.data(), m.diverged_at.data(), m.first.data());
}

}  // namespace pelage::springs::test
