// The serial loops at -O3 (CMakeLists.txt).
#include <cmath>

#include "harness/solvers/arrays.hpp"

namespace pelage::springs {
namespace {
#include "harness/solvers/equations.inl"
#include "harness/solvers/loops.inl"
}  // namespace

Loops<float> plain_loops(float) {
  return loops<float>();
}
Loops<double> plain_loops(double) {
  return loops<double>();
}

}  // namespace pelage::springs
