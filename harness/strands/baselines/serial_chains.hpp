// The time step of docs/strands.md as serial C++: a baseline for the kernels. One thread computes one strand
// after the other. The equations are those of the kernels' source, compiled as C++ in single precision.
#pragma once
#include <vector>

#include "harness/strands/chain/chain.hpp"

namespace pelage::strands {

/// The constants of a strand, as loops in C++ read them. Vectors are in the object's frame. The members have
/// the meanings of the columns STRAND_ROOT to STRAND_PHASE_SIN in kernels/strands/chain/params.h.
struct SerialStrand {
  float root[3], rest[3], normal[3];
  float shortness, stiff_first, stiff_second, limit_first, limit_second, phase_cos, phase_sin;
};

/// The state of a strand: the columns CHAIN_FIRST to CHAIN_STOP in kernels/strands/chain/params.h.
struct SerialState {
  float u[3], w[3], a[3], b[3], stop[4];
};

/// Advances `count` strands by p.substeps steps. moments[p.first_moment] belongs to the first step.
using SerialLoop = void (*)(const ChainParams& p, const ChainMoment* moments, const SerialStrand* strands,
                            SerialState* states, int count);

// The same loop, compiled with -O3, and with -O3 -march=native -ffast-math. Without the CMake option
// PELAGE_NATIVE, the second loop is compiled without -march=native.
extern const SerialLoop plain_chain_loop, fast_chain_loop;

class SerialChains {
 public:
  /// Creates the strands at rest at time 0. Throws InputError if a value is not valid.
  SerialChains(const std::vector<Chain>& chains, const ChainDynamics& dynamics, SerialLoop loop);
  void advance(int substeps);
  std::vector<ChainState> states() const;

 private:
  ChainDynamics dynamics_;
  ChainParams params_;
  SerialLoop loop_;
  std::vector<SerialStrand> strands_;
  std::vector<SerialState> states_;
  std::vector<ChainMoment> moments_;
  long steps_ = 0, known_from_ = 0;
};

}  // namespace pelage::strands
