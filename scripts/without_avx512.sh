#!/usr/bin/env bash
# Runs a command as on a processor with AVX2 and without AVX-512: PoCL compiles kernels for the processor "haswell", which
# is part of the device's name in the results. The script needs g++ and Debian's package llvm-15-dev, because PoCL 3.1
# uses LLVM 15.
# Usage: scripts/without_avx512.sh COMMAND ARGUMENT...
set -euo pipefail
(($# > 0)) || { sed -n 's/^# //p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cache=${XDG_CACHE_HOME:-$HOME/.cache}/pelage-without-avx512
library=$cache/without_avx512.so
mkdir -p "$cache"
if [[ ! $library -nt $here/without_avx512.cpp ]]; then
  g++ -std=c++17 -O2 -fPIC -shared -fno-rtti -I/usr/lib/llvm-15/include "$here/without_avx512.cpp" -o "$library" -ldl
fi
# PoCL's cache of compiled kernels does not know the instructions that a kernel was compiled for.
POCL_CACHE_DIR=$cache/kernels LD_PRELOAD=$library exec "$@"
