// Pictures on disk: PNG is written by libpng, everything else by OpenImageIO, loaded when it is needed.
#pragma once
#include <filesystem>

#include "harness/picture/picture.hpp"

namespace pelage {

/// Most pixels per side that a picture may have, read or written.
inline constexpr int most_pixels_per_side = 16384;

/// Writes a picture by its extension. PNG: 8-bit RGB, values clamped to [0, 1] and rounded (they are in gamma
/// space already). EXR and TIFF: 32-bit float RGBA, as they are. The file appears whole or not at all. Throws
/// InputError for another extension, an empty picture, or a place that cannot be written.
void write_picture(const std::filesystem::path& path, const Picture& picture);

/// Throws InputError when write_picture could not write there, by extension or by folder: before the work,
/// not after.
void check_picture_path(const std::filesystem::path& path);

/// Reads a PNG, JPEG, TIFF or EXR file, integers scaled to [0, 1], without any colour conversion. Grey
/// becomes RGB; a missing alpha is 1. Throws InputError when the file is missing, of another kind, malformed,
/// truncated, or larger than most_pixels_per_side on a side.
Picture read_picture(const std::filesystem::path& path);

}  // namespace pelage
