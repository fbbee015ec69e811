// Interface of the image module (harness/picture/module).
#pragma once
#include <filesystem>
#include <string>

#include "harness/picture/picture.hpp"
#include "harness/picture/text_mask.hpp"

namespace pelage {

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
