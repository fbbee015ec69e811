// Picture files: libpng writes PNG; OpenImageIO, loaded on demand, reads and writes all other formats.
#pragma once
#include <filesystem>

#include "harness/picture/picture.hpp"

namespace pelage {

/// The largest number of pixels per side of a picture, read or written.
inline constexpr int most_pixels_per_side = 16384;

/// Writes a picture in the format of the extension. PNG: 8-bit RGB, values clamped to [0, 1] and rounded
/// (they are already in gamma space). EXR and TIFF: 32-bit float RGBA, unchanged. The write is atomic. Throws
/// InputError for another extension, an empty picture, or a path that cannot be written.
void write_picture(const std::filesystem::path& path, const Picture& picture);

/// Throws InputError if write_picture cannot write this path because of its extension or folder. Callers use
/// it before long work.
void check_picture_path(const std::filesystem::path& path);

/// Reads a PNG, JPEG, TIFF or EXR file without colour conversion; integers are scaled to [0, 1]. Grey becomes
/// RGB; a missing alpha is 1. Throws InputError if the file is missing, of another format, malformed,
/// truncated, or larger than most_pixels_per_side on a side.
Picture read_picture(const std::filesystem::path& path);

}  // namespace pelage
