// What the module of image files (harness/picture/module) offers to the rest of pelage.
#pragma once
#include <filesystem>
#include <string>

#include "harness/picture/picture.hpp"

namespace pelage {

/// Both throw InputError, which calls the file `name`.
struct ImageModule {
  /// Reads a file that exists; `kind` is the format's usual extension without its dot.
  Picture (*read)(const std::filesystem::path& file, const std::string& kind);
  /// Writes 32-bit float RGBA in the format that the file's extension names.
  void (*write_float)(const std::filesystem::path& file, const std::string& name, const Picture& picture);
};

/// The module, loaded at the first call. Throws InputError when it is missing or cannot be loaded.
const ImageModule& image_module();

}  // namespace pelage
