// The double-precision reference for strands between key strands (docs/strands.md, section Drawing). It
// shares no code with the kernels.
#pragma once
#include <vector>

#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/drawing/keyed.hpp"

namespace pelage::strands::reference {

/// Returns the curve of a strand between three of the key strands `keys`. `first_segment` is the length of
/// the first segment in lengths of the strand, above 0 and below 1. The strand's rank is the number of its
/// fur layer; the caller knows the look, and replaces the rank if the look orders the layers differently.
DrawnStrand between(const std::vector<KeyStrand>& keys, const KeyedStrand& strand, float first_segment);

}  // namespace pelage::strands::reference
