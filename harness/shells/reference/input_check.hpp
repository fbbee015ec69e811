// Checks the input of the reference renderer.
#pragma once
#include "harness/shells/reference/reference.hpp"

namespace pelage::reference {

/// Throws InputError if the sizes of the input's arrays do not match, or if the options do not fit the input.
void check_input(const FrameInput& input, const Options& options);

}  // namespace pelage::reference
