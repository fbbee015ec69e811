// Answers in LLVM's place when PoCL asks which instructions the processor has, and leaves out AVX-512. PoCL
// then compiles kernels for AVX2, as on a laptop. scripts/without_avx512.sh compiles and preloads this
// library. Mesa's llvmpipe asks the processor itself, and uses vectors of 256 bits in both cases.
#include <dlfcn.h>

#include "llvm/ADT/StringMap.h"
#include "llvm/ADT/StringRef.h"

namespace llvm::sys {

bool getHostCPUFeatures(StringMap<bool, MallocAllocator>& features) {
  using Function = bool (*)(StringMap<bool, MallocAllocator>&);
  const auto real = reinterpret_cast<Function>(
      dlsym(dlopen("libLLVM-15.so.1", RTLD_LAZY),
            "_ZN4llvm3sys18getHostCPUFeaturesERNS_9StringMapIbNS_15MallocAllocatorEEE"));
  if (real == nullptr || !real(features)) return false;
  for (auto& feature : features) {
    const StringRef name = feature.getKey();
    // Haswell, the first processor with AVX2, has none of these.
    if (name.startswith("avx512") || name == "gfni" || name == "vaes" || name == "vpclmulqdq")
      feature.second = false;
  }
  return true;
}

StringRef getHostCPUName() {
  return "haswell";
}

}  // namespace llvm::sys
