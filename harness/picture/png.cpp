#include "harness/picture/png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <system_error>
#include <vector>

#include "harness/error.hpp"

namespace pelage {
namespace {

std::uint8_t to_byte(float value) {
  // NaN must not become an arbitrary byte. std::clamp would return it unchanged, because both of its
  // comparisons are false for NaN.
  if (std::isnan(value)) return 0;
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

std::vector<std::uint8_t> rgb_bytes(const Picture& picture) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(picture.pixel.size() * 3);
  for (const glm::vec4& pixel : picture.pixel) {
    for (int channel = 0; channel < 3; ++channel) bytes.push_back(to_byte(pixel[channel]));
  }
  return bytes;
}

// libpng reports errors by longjmp(), which skips destructors. No object in the skipped scopes may have a
// destructor.
bool encode(png_structp png, png_infop info, std::FILE* file, const Picture& picture, const png_byte* rgb) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  const auto width = static_cast<png_uint_32>(picture.width),
             height = static_cast<png_uint_32>(picture.height);
  png_init_io(png, file);
  png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
  // Pictures of fur are noisy. For such pictures, libpng's default settings take three times as long as the
  // settings below, and give files that are a tenth larger.
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_AVG);
  png_set_compression_level(png, 1);
  png_write_info(png, info);
  for (std::size_t y = 0; y < height; ++y) png_write_row(png, rgb + y * width * 3);
  png_write_end(png, info);
  return true;
}

}  // namespace

void write_png(const std::filesystem::path& file, const std::string& name, const Picture& picture) {
  const std::vector<std::uint8_t> rgb = rgb_bytes(picture);
  png_structp png = png_create_write_struct(
      PNG_LIBPNG_VER_STRING, nullptr, [](png_structp at, png_const_charp) { png_longjmp(at, 1); },
      [](png_structp, png_const_charp) {});
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  std::FILE* to = std::fopen(file.c_str(), "wb");
  bool whole = info && to && encode(png, info, to, picture, rgb.data());
  int reason = errno;
  png_destroy_write_struct(&png, &info);
  if (to && std::fclose(to) != 0 && whole) {
    whole = false;
    reason = errno;
  }
  if (!whole)
    throw InputError(fmt::format("{}: cannot be written: {}", name, std::generic_category().message(reason)));
}

}  // namespace pelage
