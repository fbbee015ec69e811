#define KERNELS stick_kernels
#define CORNERS 1
#define EDGES 0
#include "tests/springs/opencl/shim_kernels.inl"
