// The options of the OpenGL baseline of strands as text.
#pragma once
#include <string>

#include "harness/strands/opengl/ribbons.hpp"

namespace pelage::strands {

/// Reads options such as "expand=indexed,target=rgba8". Options that are absent keep their defaults. Throws
/// InputError for an unknown name or value.
RibbonOptions ribbon_options(const std::string& text);

/// Returns all options as text that ribbon_options() reads.
std::string to_text(const RibbonOptions& options);

}  // namespace pelage::strands
