#define KERNELS triangle_kernels
#define CORNERS 3
#define EDGES 1
#include "tests/springs/opencl/shim_kernels.inl"
