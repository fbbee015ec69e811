#include "harness/picture/image_module.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <chrono>
#include <iterator>
#include <thread>

#include "harness/error.hpp"
#include "harness/isolated/isolated.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

// Searches for the module in three folders: the folder of the running program, the parent of this folder, and
// the module folder of an installation. The test programs find the module in the parent folder. A run path
// (RPATH) is not sufficient: under AddressSanitizer, dlopen() does not use the run path of its caller.
fs::path module_file() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  for (const char* place : {".", "..", PELAGE_MODULE_FOLDER}) {
    const fs::path file = (folder / place / PELAGE_IMAGE_MODULE).lexically_normal();
    if (fs::exists(file)) return file;
  }
  throw InputError(fmt::format(
      "{} is missing: pelage needs it to read pictures and to write EXR and TIFF; put it into {} or {}",
      PELAGE_IMAGE_MODULE, folder.string(), (folder / PELAGE_MODULE_FOLDER).lexically_normal().string()));
}

/// Returns the number of threads of this process.
std::ptrdiff_t thread_count() {
  std::error_code error;
  return std::distance(fs::directory_iterator("/proc/self/task", error), fs::directory_iterator());
}

// When it is loaded, OpenImageIO starts worker threads, and the module ends them at once. They hold a lock
// while they end. A child process that is forked at this moment inherits the locked lock and waits for ever,
// so the threads must be gone before image_module() returns. Threads of other libraries may start meanwhile,
// so the wait has a limit.
void wait_for_threads(std::ptrdiff_t expected) {
  for (int i = 0; i < 500 && thread_count() > expected; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace

const ImageModule& image_module() {
  // The module is never unloaded, because OpenImageIO keeps its own threads running.
  static const auto* const module = [] {
    const std::ptrdiff_t threads = thread_count();
    void* const library = ::dlopen(module_file().c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const symbol = library ? ::dlsym(library, "pelage_image_module") : nullptr;
    if (!symbol) throw InputError(fmt::format("the image module cannot be loaded: {}", ::dlerror()));
    wait_for_threads(threads);
    return static_cast<const ImageModule*>(symbol);
  }();
  return *module;
}

namespace {

constexpr Limits font_limits{
    .memory = std::uint64_t(2) << 30, .time = std::chrono::seconds(60), .what = "font"};

}  // namespace

bool TextMask::inside(double u, double v) const {
  if (!(u >= 0 && u < 1 && v > 0 && v <= 1)) return false;
  const auto column = std::size_t(u * side), row = std::size_t((1.0 - v) * side);
  return byte[row * std::size_t(side) + column] >= 128;
}

fs::path default_font() {
  const fs::path file = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";
  std::error_code error;
  if (fs::is_regular_file(file, error)) return file;
  throw InputError(fmt::format(
      "wetness.text: there is no {}; install Debian's package fonts-dejavu-core, or give another font as wetness.text_font",
      file.string()));
}

TextMask paint_text(const TextLine& line, int side) {
  std::error_code error;
  if (!fs::is_regular_file(line.font, error))
    throw InputError(fmt::format("{}: there is no such font file", line.font.string()));
  const ImageModule& module = image_module();
  const std::string bytes = isolated(line.font.string(), font_limits,
                                     [&](const Say&) { return module.text_bytes(line, side); }, {});
  return {side, {bytes.begin(), bytes.end()}};
}

}  // namespace pelage
