// PNG files, written by libpng itself: a render needs no other format.
#pragma once
#include <filesystem>
#include <string>

#include "harness/picture/picture.hpp"

namespace pelage {

/// 8-bit RGB, marked as sRGB. Throws InputError, which calls the file `name`, when it cannot be written.
void write_png(const std::filesystem::path& file, const std::string& name, const Picture& picture);

}  // namespace pelage
