#include "harness/picture/image_module.hpp"
#include "tests/fuzz/support.hpp"
#include "tests/fuzz/targets.hpp"

namespace pelage::fuzz {

void picture(std::string_view bytes) {
  if (bytes.empty()) return;
  static const char* const kinds[] = {"png", "jpeg", "tiff", "openexr"};
  const MemoryFile file(bytes.substr(1));
  may_refuse([&] {
    const Picture read = image_module().read(file.path(), kinds[static_cast<unsigned char>(bytes[0]) % 4]);
    expect(read.width > 0 && read.height > 0 &&
               read.pixel.size() == std::size_t(read.width) * std::size_t(read.height),
           "a picture with a wrong number of pixels");
  });
}

}  // namespace pelage::fuzz
