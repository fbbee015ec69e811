// Compiles whole kernels, with their indexing and memory accesses, as C++ in double precision.
// opencl_as_cpp.hpp compiles only the equations of the kernels in this way. A source file includes this
// header and then, in its own namespace, a .cl file.
#pragma once
#include <cstddef>

#include "tests/support/opencl_as_cpp.hpp"

namespace pelage::in_double {

struct real4 {
  real x, y, z, w;
};

template <class T>
real4 load_rows(const T* table, whole i) {
  const T* row = table + std::ptrdiff_t{4} * i;
  return {real(row[0]), real(row[1]), real(row[2]), real(row[3])};
}
template <class T>
real4 gather_rows(const T* table, whole i) {
  return load_rows(table, i);
}
inline void store_rows(real4 v, real* table, whole i) {
  real* row = table + std::ptrdiff_t{4} * i;
  row[0] = v.x, row[1] = v.y, row[2] = v.z, row[3] = v.w;
}
template <class T>
real load_real(const T* table, whole i) {
  return real(table[i]);
}
inline void store_real(real v, real* table, whole i) {
  table[i] = v;
}
inline whole load_whole(const whole* table, whole i) {
  return table[i];
}
inline void store_whole(whole v, whole* table, whole i) {
  table[i] = v;
}
inline void spill_whole(whole v, whole* lanes) {
  *lanes = v;
}
inline whole lane_numbers() {
  return 0;
}
inline int atomic_min(int* place, int value) {
  const int before = *place;
  *place = std::min(before, value);
  return before;
}

/// Index of the work-item of the next kernel call.
inline int work_item = 0;
inline int get_global_id(int) {
  return work_item;
}

}  // namespace pelage::in_double

#define LANES 1
// NOLINTBEGIN(bugprone-reserved-identifier): these are keywords of OpenCL C
#define __kernel static inline
#define __global
// NOLINTEND(bugprone-reserved-identifier)
