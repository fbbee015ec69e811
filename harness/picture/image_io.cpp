#include "harness/picture/image_io.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "harness/atomic_file.hpp"
#include "harness/error.hpp"
#include "harness/isolated/isolated.hpp"
#include "harness/picture/image_module.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

std::string extension(const fs::path& path) {
  return boost::algorithm::to_lower_copy(path.extension().string());
}

// Memory for the largest picture: 48 bytes per pixel of 8192 x 8192, and the decoder's own memory.
constexpr Limits limits{
    .memory = std::uint64_t(6) << 30, .time = std::chrono::seconds(120), .what = "picture"};

constexpr std::size_t header_bytes = 2 * sizeof(int) + sizeof(float);

// Converts a picture to bytes and back, to pass it from the process that reads the file.
std::string encoded(const Picture& picture) {
  std::string bytes;
  bytes.reserve(header_bytes + picture.pixel.size() * sizeof(glm::vec4));
  for (const int side : {picture.width, picture.height})
    bytes.append(reinterpret_cast<const char*>(&side), sizeof side);
  bytes.append(reinterpret_cast<const char*>(&picture.gamma), sizeof picture.gamma);
  bytes.append(reinterpret_cast<const char*>(picture.pixel.data()), picture.pixel.size() * sizeof(glm::vec4));
  return bytes;
}

Picture decoded(const std::string& bytes) {
  Picture picture;
  std::memcpy(&picture.width, bytes.data(), sizeof(int));
  std::memcpy(&picture.height, bytes.data() + sizeof(int), sizeof(int));
  std::memcpy(&picture.gamma, bytes.data() + 2 * sizeof(int), sizeof(float));
  picture.pixel.resize((bytes.size() - header_bytes) / sizeof(glm::vec4));
  std::memcpy(picture.pixel.data(), bytes.data() + header_bytes, picture.pixel.size() * sizeof(glm::vec4));
  return picture;
}

std::uint8_t to_byte(float value) {
  // NaN must not become an arbitrary byte. std::clamp would return it unchanged, because both of its
  // comparisons are false for NaN.
  if (std::isnan(value)) return 0;
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

std::vector<std::uint8_t> rgb_bytes(const Picture& picture) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(picture.pixel.size() * 3);
  for (const glm::vec4& pixel : picture.pixel)
    for (int channel = 0; channel < 3; ++channel) bytes.push_back(to_byte(pixel[channel]));
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

// Writes 8-bit RGB, marked as sRGB. Error messages call the file `name`.
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

/// The index of a pixel of the original picture, and the weight of this pixel in the mean that gives a pixel
/// of the reduced picture.
struct Share {
  int pixel;
  float weight;
};

/// Computes how a row or column of `from` pixels is reduced to `to` pixels. Returns, for each reduced pixel,
/// the original pixels that it covers, with their weights.
std::vector<std::vector<Share>> shares_of(int from, int to) {
  std::vector<std::vector<Share>> shares(static_cast<std::size_t>(to));
  const double step = double(from) / to;
  for (int i = 0; i < to; ++i) {
    const double start = i * step, end = std::min(double(from), (i + 1) * step);
    for (int p = int(start); p < from && p < end; ++p)
      if (const double weight = (std::min(end, p + 1.0) - std::max(start, double(p))) / step; weight > 0)
        shares[std::size_t(i)].push_back({p, float(weight)});
  }
  return shares;
}

}  // namespace

void check_picture_path(const fs::path& path) {
  const std::string kind = extension(path);
  if (kind != ".png" && kind != ".exr" && kind != ".tif" && kind != ".tiff")
    throw InputError(fmt::format("{}: a picture is written as .png, .exr or .tif", path.string()));
  require_place(path);
  if (kind != ".png") image_module();
}

void write_picture(const fs::path& path, const Picture& picture) {
  check_picture_path(path);
  if (picture.width < 1 || picture.height < 1 || picture.width > most_pixels_per_side ||
      picture.height > most_pixels_per_side ||
      picture.pixel.size() !=
          static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height)) {
    throw InputError(
        fmt::format("{}: a picture of {} x {} pixels cannot be written; each side must have 1 to {}",
                    path.string(), picture.width, picture.height, most_pixels_per_side));
  }
  write_atomically(path, [&](const fs::path& temporary) {
    if (extension(path) == ".png")
      write_png(temporary, path.string(), picture);
    else
      image_module().write_float(temporary, path.string(), picture);
  });
}

Picture read_picture(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw InputError(fmt::format("{}: there is no such file", path.string()));
  if (!fs::is_regular_file(path, error)) throw InputError(fmt::format("{}: not a file", path.string()));
  // Only the extension selects the format. If pelage gave no format, OpenImageIO would try the readers of all
  // its formats.
  static constexpr std::pair<const char*, const char*> kinds[] = {{".png", "png"},   {".jpg", "jpeg"},
                                                                  {".jpeg", "jpeg"}, {".tif", "tiff"},
                                                                  {".tiff", "tiff"}, {".exr", "openexr"}};
  for (const auto& [ending, kind] : kinds)
    if (extension(path) == ending) {
      // Loading the module takes 0.3 s. The parent process loads it, so this happens once and not for each
      // picture.
      const ImageModule& module = image_module();
      return decoded(isolated(path.string(), limits,
                              [&, kind = kind](const Say&) { return encoded(module.read(path, kind)); }, {}));
    }
  throw InputError(
      fmt::format("{}: pelage does not read this format; it reads PNG, JPEG, TIFF and EXR", path.string()));
}

std::string webp_of(const Picture& picture, int quality) {
  // OpenImageIO cannot write WebP to memory, so the picture is written to a temporary file.
  std::string folder = (temporary_folder() / "pelage-webp-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr)
    throw InputError(fmt::format("WebP: the folder {} cannot be made", folder));
  struct Remove {
    fs::path folder;
    ~Remove() {
      std::error_code ignored;
      fs::remove_all(folder, ignored);
    }
  } const remove{folder};
  const fs::path file = fs::path(folder) / "picture.webp";
  image_module().write_webp(file, picture, quality);
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

Picture reduced(const Picture& picture, int most_width) {
  if (picture.width <= most_width) return picture;
  const int height = std::max(1, int(std::lround(double(picture.height) * most_width / picture.width)));
  const auto columns = shares_of(picture.width, most_width), rows = shares_of(picture.height, height);
  Picture across{most_width, picture.height,
                 std::vector<glm::vec4>(std::size_t(most_width) * std::size_t(picture.height))};
  for (int y = 0; y < across.height; ++y)
    for (int x = 0; x < across.width; ++x)
      for (const Share& share : columns[std::size_t(x)])
        across.at(x, y) += share.weight * picture.at(share.pixel, y);
  Picture result{most_width, height, std::vector<glm::vec4>(std::size_t(most_width) * std::size_t(height))};
  for (int y = 0; y < height; ++y)
    for (const Share& share : rows[std::size_t(y)])
      for (int x = 0; x < most_width; ++x) result.at(x, y) += share.weight * across.at(x, share.pixel);
  return result;
}

}  // namespace pelage
