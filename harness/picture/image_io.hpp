// Picture files. libpng writes PNG, so that `pelage render` need not load OpenImageIO for a PNG file.
// OpenImageIO, which is loaded on demand, reads all formats and writes all formats except PNG.
#pragma once
#include <filesystem>
#include <string>

#include "harness/picture/picture.hpp"

namespace pelage {

/// The largest number of pixels per side of a picture that is read or written.
inline constexpr int most_pixels_per_side = 16384;

/// Writes a picture in the format that the extension of `path` selects. A PNG file contains 8-bit RGB values.
/// The picture's values are already in gamma space; the function clamps them to [0, 1] and rounds them. EXR
/// and TIFF files contain the unchanged values as 32-bit float RGBA. The write is atomic: the file appears
/// complete or not at all. Throws InputError if the extension is none of .png, .exr, .tif and .tiff, if the
/// picture is empty, or if the path cannot be written.
void write_picture(const std::filesystem::path& path, const Picture& picture);

/// Throws InputError if write_picture() cannot write `path` because of its extension or its folder. Callers
/// use this function before a long computation, so that they detect such an error early.
void check_picture_path(const std::filesystem::path& path);

/// Reads a PNG, JPEG, TIFF or EXR file without colour conversion. Integer values are scaled to [0, 1]. A grey
/// picture becomes RGB; a missing alpha channel becomes 1. Throws InputError if the file is missing, has
/// another format, is malformed or truncated, or has more than most_pixels_per_side pixels on a side. A child
/// process decodes the file, because damaged files crash the decoders of OpenImageIO or make them allocate
/// gigabytes.
Picture read_picture(const std::filesystem::path& path);

/// Compresses the picture to a WebP file with 8-bit RGB values, and returns the bytes of the file. Clamps the
/// values of the picture to [0, 1] and rounds them to 8 bits. `quality` is 1 to 100. Throws InputError if the
/// picture cannot be compressed.
std::string webp_of(const Picture& picture, int quality);

/// Returns a smaller copy of the picture with `most_width` columns and the same proportions. Each reduced
/// pixel is the mean of the original pixels that it covers, computed from gamma-encoded values. Alpha is
/// averaged, too. If the picture has at most `most_width` columns, returns it unchanged.
Picture reduced(const Picture& picture, int most_width);

}  // namespace pelage
