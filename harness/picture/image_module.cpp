#include "harness/picture/image_module.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "harness/error.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

// Beside pelage, above the tests of a build folder, or where it is installed. A run path would do, were it
// not that AddressSanitizer's dlopen forgets whose it is.
fs::path module_file() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  for (const char* place : {".", "..", PELAGE_MODULE_FOLDER}) {
    const fs::path file = (folder / place / PELAGE_IMAGE_MODULE).lexically_normal();
    if (fs::exists(file)) return file;
  }
  throw InputError(fmt::format(
      "{} is missing, which reads pictures and writes EXR and TIFF: it belongs beside {} or in {}",
      PELAGE_IMAGE_MODULE, folder.string(), (folder / PELAGE_MODULE_FOLDER).lexically_normal().string()));
}

}  // namespace

const ImageModule& image_module() {
  // Never closed: OpenImageIO keeps threads of its own.
  static const auto* const module = [] {
    void* const library = ::dlopen(module_file().c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const symbol = library ? ::dlsym(library, "pelage_image_module") : nullptr;
    if (!symbol) throw InputError(fmt::format("the module of image files cannot be loaded: {}", ::dlerror()));
    return static_cast<const ImageModule*>(symbol);
  }();
  return *module;
}

}  // namespace pelage
