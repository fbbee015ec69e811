// The loops of loops.inl, compiled with -O3 (set in CMakeLists.txt).
#include <cmath>

#include "harness/springs/baselines/arrays.hpp"

namespace pelage::springs {
namespace {
#include "harness/springs/baselines/equations.inl"
#include "harness/springs/baselines/loops.inl"
}  // namespace

Loops<float> plain_loops(float) {
  return loops<float>();
}
Loops<double> plain_loops(double) {
  return loops<double>();
}

}  // namespace pelage::springs
