// Defines the names of kernels/dialect.clh for C++, with one lane in double precision. A test includes this
// file and then, inside namespace pelage::in_double, the .clh files that it tests. In this way it tests the
// kernels' source without a device. A kernel file must be included only once per translation unit, and
// kernels/ must be on the include path.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#ifdef __clang__  // The truth values of kernels are vectors, whose operators are & and |.
#pragma clang diagnostic ignored "-Wbitwise-instead-of-logical"
#endif

namespace pelage::in_double {

using scalar = double;
using real = double;
using whole = std::int32_t;
using wide = std::int64_t;
using truth = bool;

using std::fabs;
using std::floor;
using std::fma;
using std::fmax;
using std::fmin;
using std::log2;
using std::max;
using std::min;
using std::pow;
using std::rint;
using std::sqrt;

inline real gather(const float* table, whole i) {
  return real(table[i]);
}
inline whole gather_whole(const std::int32_t* table, whole i) {
  return table[i];
}
inline real bits_as_real(whole bits) {
  return real(std::bit_cast<float>(bits));
}
inline real floor_real(real x) {
  return floor(x);
}
inline real inverse_root(real x) {
  return 1 / sqrt(x);
}
inline real inverse(real x) {
  return 1 / x;
}
inline bool some(truth m) {
  return m;
}

}  // namespace pelage::in_double

#define TABLE(type) const type*
#define INLINE static inline
#define CALLED static inline
#define to_real (real)
#define to_whole (whole)
#define to_wide (wide)
#define narrow (whole)
