// Writes PNG files with libpng, so that a render does not load OpenImageIO.
#pragma once
#include <filesystem>
#include <string>

#include "harness/picture/picture.hpp"

namespace pelage {

/// Writes 8-bit RGB, marked as sRGB. Throws InputError if the file cannot be written; the message calls it
/// `name`.
void write_png(const std::filesystem::path& file, const std::string& name, const Picture& picture);

}  // namespace pelage
