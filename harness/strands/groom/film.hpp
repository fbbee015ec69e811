// Film strips of fur layers, from picture files.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "harness/strands/drawing/drawing.hpp"

namespace pelage::strands {

/// Reads a film strip: a picture with 8 columns, from the root at the left to the tip at the right, and one
/// row per frame. Red is the luminance and green the gloss, where 128/255 means 1. Blue is the transparency.
/// Throws InputError if the picture cannot be read or has another size. `key` is the scene key in messages.
std::vector<FilmFrame> read_film(const std::filesystem::path& path, const std::string& key);

}  // namespace pelage::strands
