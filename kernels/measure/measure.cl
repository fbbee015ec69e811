// Kernels of `pelage devices --measure`. They measure the peak rates of a device and the time of a kernel
// launch. The kernel chains() also checks the device's timer.
#include "dialect.clh"

// McCalpin's STREAM triad, a = b + s c: 12 bytes and 2 operations per float.
__kernel void triad(__global float *a, __global const float *b, __global const float *c, float s) {
  int block = (int)get_global_id(0);
  store_real(fma(REAL(s), load_real(c, block), load_real(b, block)), a, block);
}

// Measures the arithmetic peak. Eight independent chains of fma hide the latency of fma on all devices
// tested. A work-item computes 16 * LANES * rounds operations. The iteration x -> x / 2 + 1 converges to 2,
// so no operand is denormal or infinite. The factor 1/2 is the argument half_, so that the compiler cannot
// precompute the result.
__kernel void chains(int rounds, float half_, __global float *out) {
  int item = (int)get_global_id(0);
  real h = REAL(half_), one = REAL(1.0f);
  real x0 = REAL((float)item), x1 = x0 + one, x2 = x1 + one, x3 = x2 + one;
  real x4 = x3 + one, x5 = x4 + one, x6 = x5 + one, x7 = x6 + one;
  for (int i = 0; i < rounds; ++i) {
    x0 = fma(x0, h, one);
    x1 = fma(x1, h, one);
    x2 = fma(x2, h, one);
    x3 = fma(x3, h, one);
    x4 = fma(x4, h, one);
    x5 = fma(x5, h, one);
    x6 = fma(x6, h, one);
    x7 = fma(x7, h, one);
  }
  store_real(((x0 + x1) + (x2 + x3)) + ((x4 + x5) + (x6 + x7)), out, item);
}

__kernel void nothing(__global float *out) {
  if (get_global_id(0) == 0) out[0] = 1.0f;
}

// A kernel with almost no work and with seven buffer arguments, about as many as the smaller mass-spring
// kernels have. A launch of this kernel takes longer than a launch of nothing(), because OpenCL processes
// every buffer argument at a launch.
__kernel void nothing_of_seven(__global float *a, __global float *b, __global float *c, __global float *d, __global float *e,
                               __global float *f, __global float *g) {
  if (get_global_id(0) == 0) a[0] = b[0] = c[0] = d[0] = e[0] = f[0] = g[0] = 1.0f;
}
