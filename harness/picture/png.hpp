// Writes PNG files with libpng, so that `pelage render` need not load OpenImageIO for a PNG file.
#pragma once
#include <filesystem>
#include <string>

#include "harness/picture/picture.hpp"

namespace pelage {

/// Writes 8-bit RGB, marked as sRGB. Throws InputError if the file cannot be written. The message uses `name`
/// as the file's name.
void write_png(const std::filesystem::path& file, const std::string& name, const Picture& picture);

}  // namespace pelage
