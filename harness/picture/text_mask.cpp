#include "harness/picture/text_mask.hpp"

#include <fmt/format.h>

#include "harness/error.hpp"
#include "harness/isolated/isolated.hpp"
#include "harness/picture/image_module.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

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
