// The loop of SerialLoop. plain_loop.cpp and fast_loop.cpp include this file with different compiler flags, each in a
// namespace of its own, LOOP_SPACE. The loop uses no inline functions of the standard library, because the linker could
// use their copies of fast_loop.cpp in other files.
#include "harness/strands/baselines/serial_chains.hpp"

namespace pelage::strands::LOOP_SPACE {
namespace {

using scalar = float;
using real = float;
using whole = int;
using wide = long;
using truth = bool;

inline float fma(float a, float b, float c) { return a * b + c; }
inline float fmax(float a, float b) { return a > b ? a : b; }
inline float fmin(float a, float b) { return a < b ? a : b; }
inline float sqrt(float x) { return __builtin_sqrtf(x); }
inline float fabs(float x) { return __builtin_fabsf(x); }
inline real inverse_root(real x) { return 1 / sqrt(x); }
inline real inverse(real x) { return 1 / x; }
inline bool some(truth m) { return m; }

#define TABLE(type) const type*
#define INLINE inline
#define to_real (real)
#define to_whole (whole)
#include "strands/chain/step.clh"

inline real3 loaded(const float* v) { return vec3(v[0], v[1], v[2]); }
inline void stored(real3 v, float* to) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }

void advance(const ChainParams& p, const ChainMoment* moments, const SerialStrand* strands, SerialState* states,
             int count) {
  for (int i = 0; i < count; ++i) {
    const SerialStrand& strand = strands[i];
    SerialState& state = states[i];
    Hold s;
    s.stiff_first = strand.stiff_first;
    s.stiff_second = strand.stiff_second;
    s.limit_first = strand.limit_first;
    s.limit_second = strand.limit_second;
    s = with_theta(p, s);
    Chain c;
    c.u = loaded(state.u), c.w = loaded(state.w), c.a = loaded(state.a), c.b = loaded(state.b);
    for (int k = 0; k < STOPS; ++k) c.stop[k] = state.stop[k];
    bool none = false;
    const real3 rest = loaded(strand.rest), normal = loaded(strand.normal), root = loaded(strand.root);
    for (int k = 0; k < p.substeps; ++k) {
      const ChainMoment& t = moments[p.first_moment + k];
      s.rest = in_world(t, rest);
      s.normal = in_world(t, normal);
      c = stepped(p, s, pull_on(p, t, root, strand.shortness, strand.phase_cos, strand.phase_sin), c, 0, &none);
    }
    stored(c.u, state.u), stored(c.w, state.w), stored(c.a, state.a), stored(c.b, state.b);
    for (int k = 0; k < STOPS; ++k) state.stop[k] = c.stop[k];
  }
}

}  // namespace
}  // namespace pelage::strands::LOOP_SPACE
