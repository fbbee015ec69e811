// A second implementation of kernels/dialect.clh in C++ (the first is tests/support/opencl_as_cpp.hpp). A
// `real` of this implementation is one number, not a vector. The type counts the arithmetic operations. An
// fma counts as two operations. A logarithm or a power counts as many operations as the kernels' code needs
// to compute it. Comparisons, selections, conversions and negations are not counted.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pelage::counting {

inline double operations = 0;

struct real {
  double value = 0;
  real() = default;
  real(double v) : value(v) {}
  explicit operator std::int32_t() const { return std::int32_t(value); }
};
using scalar = double;
using whole = std::int32_t;
using wide = std::int64_t;
using truth = bool;

inline real counted(double value, double cost = 1) {
  operations += cost;
  return {value};
}
inline real operator+(real a, real b) {
  return counted(a.value + b.value);
}
inline real operator-(real a, real b) {
  return counted(a.value - b.value);
}
inline real operator*(real a, real b) {
  return counted(a.value * b.value);
}
inline real operator/(real a, real b) {
  return counted(a.value / b.value);
}
inline real& operator+=(real& a, real b) {
  return a = a + b;
}
inline real operator-(real a) {
  return {-a.value};
}
inline bool operator<(real a, real b) {
  return a.value < b.value;
}
inline bool operator>(real a, real b) {
  return a.value > b.value;
}
inline bool operator<=(real a, real b) {
  return a.value <= b.value;
}
inline bool operator>=(real a, real b) {
  return a.value >= b.value;
}
inline bool operator==(real a, real b) {
  return a.value == b.value;
}
inline bool operator!=(real a, real b) {
  return a.value != b.value;
}

inline real fma(real a, real b, real c) {
  return counted(a.value * b.value + c.value, 2);
}
inline real sqrt(real a) {
  return counted(std::sqrt(a.value));
}
inline double sqrt(double a) {
  return std::sqrt(a);
}
inline real rint(real a) {
  return counted(std::rint(a.value));
}
inline real floor_real(real a) {
  return counted(std::floor(a.value));
}
inline real fabs(real a) {
  return {std::fabs(a.value)};
}
inline real fmin(real a, real b) {
  return {std::fmin(a.value, b.value)};
}
inline real fmax(real a, real b) {
  return {std::fmax(a.value, b.value)};
}
// The costs are those of the polynomials in kernels/common/powers.clh. log2 takes nine fma and one
// subtraction: 19 operations. pow takes one log2, seven fma, one rounding, one subtraction and one product:
// 36 operations.
inline real log2(real a) {
  return counted(std::log2(a.value), 19);
}
inline real pow(real a, real p) {
  return counted(std::pow(a.value, p.value), 36);
}
using std::max;
using std::min;

struct whole2 {
  whole first, second;
};
struct real4 {
  real x, y, z, w;
};
inline real gather(const float* table, whole i) {
  return real(double(table[i]));
}
inline whole gather_whole(const std::int32_t* table, whole i) {
  return table[i];
}
inline whole2 gather_pairs(const std::int32_t* table, whole i) {
  return {table[i], table[i + 1]};
}
struct whole4 {
  whole x, y, z, w;
};
inline whole4 gather_fours(const std::int32_t* table, whole i) {
  return {table[i], table[i + 1], table[i + 2], table[i + 3]};
}
// The kernels compute this dot product in integers. It counts as three operations, because the same product
// of floats would take two multiplications and an addition.
inline whole dot_halves(whole a, whole b) {
  operations += 3;
  const auto low = [](whole v) { return whole(std::int16_t(v)); };
  return low(a) * low(b) + (a >> 16) * (b >> 16);
}
inline real4 gather_rows(const float* table, whole i) {
  const float* row = table + 4 * std::ptrdiff_t(i);
  return {double(row[0]), double(row[1]), double(row[2]), double(row[3])};
}
inline real load_real(const float* table, int block) {
  return gather(table, block);
}
inline void read_soon(const void*, whole) {}
inline real inverse_root(real x) {
  return real(1.0) / sqrt(x);
}
inline real inverse(real x) {
  return real(1.0) / x;
}
inline bool some(truth m) {
  return m;
}

/// Returns the number of operations that `work` executes.
template <class Work>
double count(const Work& work) {
  const double before = operations;
  work();
  return operations - before;
}

/// Expects `constant` to be within 10% of `taken`, the counted number of operations. A tolerance of 10% is
/// small enough for a roofline plot. With this tolerance, small changes of the kernels do not require new
/// constants.
inline void expect_near(double constant, double taken, const char* what) {
  EXPECT_NEAR(constant, taken, 0.1 * taken) << what << ": the kernels take " << taken;
}

}  // namespace pelage::counting

#define INLINE static inline
#define TABLE(type) const type*
#define to_real (real)
#define to_whole (whole)
#define to_wide (wide)
#define narrow (whole)
