// The kernels' own text, whole kernels with their indexing and memory, as C++ in double: what
// opencl_as_cpp.hpp is to equations. A source includes this and then, in a namespace of its own, the .cl file
// it wants.
#pragma once
#include "tests/opencl_as_cpp.hpp"

namespace pelage::in_double {

struct real4 {
  real x, y, z, w;
};

template <class T>
real4 load_rows(const T* table, whole i) {
  return {real(table[4 * i]), real(table[4 * i + 1]), real(table[4 * i + 2]), real(table[4 * i + 3])};
}
template <class T>
real4 gather_rows(const T* table, whole i) {
  return load_rows(table, i);
}
inline void store_rows(real4 v, real* table, whole i) {
  table[4 * i] = v.x, table[4 * i + 1] = v.y, table[4 * i + 2] = v.z, table[4 * i + 3] = v.w;
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

/// The work-item that the next call of a kernel is.
inline int work_item = 0;
inline int get_global_id(int) {
  return work_item;
}

}  // namespace pelage::in_double

#define LANES 1
#define __kernel static inline
#define __global
