// Interface of the image module (harness/picture/module), and a line of text painted into a square picture,
// for shapes such as the wet letters of S Fig. 12.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/picture/picture.hpp"

namespace pelage {

/// A line of text in the unit square. The first row of the square's picture is at v = 1.
struct TextLine {
  std::string text;            ///< printable ASCII characters, at least one of them visible
  std::filesystem::path font;  ///< TrueType or OpenType file
  double u = 0.5, v = 0.5;     ///< centre of the painted letters
  double height = 0.2;         ///< height of the capital letter H
};

/// The painted text. `byte` has side x side values, the top row first: 255 inside a letter, 0 outside, and
/// values between them at the letters' edges.
struct TextMask {
  int side = 0;
  std::vector<std::uint8_t> byte;
  /// True if the point `uv` lies in a letter: the value of the pixel that contains it is at least 128. Points
  /// outside the unit square lie in no letter.
  bool inside(double u, double v) const;
};

/// Returns DejaVuSans-Bold.ttf, the font of texts without a font of their own. Throws InputError if it is not
/// installed.
std::filesystem::path default_font();

/// Paints the text into a picture of side x side pixels. FreeType reads the font in a child process, because
/// a damaged font may crash it. Throws InputError if the font is missing or not readable, and if the text
/// does not fit into the square.
TextMask paint_text(const TextLine& line, int side);

/// The functions of the image module. All throw InputError if they fail.
struct ImageModule {
  /// Reads an existing file. `kind` is OpenImageIO's name of the file's format, for instance "jpeg" or
  /// "openexr".
  Picture (*read)(const std::filesystem::path& file, const std::string& kind);
  /// Writes 32-bit float RGBA in the format of the file's extension. Error messages call the file `name`.
  void (*write_float)(const std::filesystem::path& file, const std::string& name, const Picture& picture);
  /// Writes the picture as a WebP file with 8-bit RGB values. `quality` is 1 to 100.
  void (*write_webp)(const std::filesystem::path& file, const Picture& picture, int quality);
  /// Paints the text, and returns the values of TextMask::byte.
  std::string (*text_bytes)(const TextLine& line, int side);
};

/// Returns the module; the first call loads it. Throws InputError if the module is missing or cannot be
/// loaded.
const ImageModule& image_module();

}  // namespace pelage
