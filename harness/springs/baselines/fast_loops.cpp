// The loops of loops.inl, compiled with -O3 -march=native -ffast-math (set in CMakeLists.txt).
#include <cmath>

#include "harness/springs/baselines/arrays.hpp"

namespace pelage::springs {
namespace {
#include "harness/springs/baselines/equations.inl"
#include "harness/springs/baselines/loops.inl"
}  // namespace

Loops<float> fast_loops(float) {
  return loops<float>();
}
Loops<double> fast_loops(double) {
  return loops<double>();
}

bool fast_loops_run_here() {
#ifdef __AVX512F__
  if (!__builtin_cpu_supports("avx512f")) return false;
#endif
#ifdef __AVX2__
  if (!__builtin_cpu_supports("avx2")) return false;
#endif
  return true;
}

}  // namespace pelage::springs
