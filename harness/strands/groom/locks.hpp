// Locks: groups of strands whose tips meet. docs/strands.md, section Authoring, defines them.
#pragma once
#include <span>
#include <vector>

#include "harness/strands/drawing/keyed.hpp"

namespace pelage::strands {

struct LockOptions {
  std::size_t locks = 0;       ///< the first `locks` strands are the middles of the locks
  float pull = 0;              ///< part of the way from a strand's tip to the tip of its middle, 0 to 1
  float first_segment = 0.5f;  ///< length of the first segment, in lengths of the strand
};

/// Turns, bends and lengthens the strands at rest, so that their tips move towards the tips of the middles of
/// their locks. A strand belongs to the lock whose middle has the nearest root on the same side of the skin.
void pull_into_locks(std::span<KeyedStrand> strands, const std::vector<KeyStrand>& keys,
                     const LockOptions& options);

}  // namespace pelage::strands
