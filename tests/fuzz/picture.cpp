#include <chrono>
#include <fstream>
#include <thread>

#include "harness/picture/image_io.hpp"
#include "harness/picture/image_module.hpp"
#include "tests/fuzz/support.hpp"
#include "tests/fuzz/targets.hpp"

namespace pelage::fuzz {

// read_picture() decodes the file in a child process. A crash of the decoder is therefore no error of this
// target: the target tests that every crash becomes an InputError, and that a decoded picture is whole.
void picture(std::string_view bytes) {
  if (bytes.empty()) return;
  // The libraries of the image module start threads when they are loaded. If such a thread allocates memory
  // while read_picture() forks, a lock of AddressSanitizer's allocator stays locked in the child for ever.
  [[maybe_unused]] static const bool loaded = [] {
    image_module();
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    return true;
  }();
  static const char* const endings[] = {".png", ".jpg", ".tif", ".exr"};
  const std::string name =
      "pelage-fuzz-" + std::to_string(::getpid()) + endings[static_cast<unsigned char>(bytes[0]) % 4];
  const std::filesystem::path file = std::filesystem::temp_directory_path() / name;
  std::ofstream(file, std::ios::binary) << bytes.substr(1);
  may_refuse([&] {
    const Picture read = read_picture(file);
    expect(read.width > 0 && read.height > 0 &&
               read.pixel.size() == std::size_t(read.width) * std::size_t(read.height),
           "a picture with a wrong number of pixels");
  });
  std::filesystem::remove(file);
}

}  // namespace pelage::fuzz
