#include "harness/picture/image_io.hpp"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "harness/atomic_file.hpp"
#include "harness/error.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t densest_codec = 4096;  // raw bytes per byte of file, with room

std::string extension(const fs::path& path) {
  std::string name = path.extension().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

/// The first line of OpenImageIO's own words; it repeats itself for every scanline.
std::string one_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "no reason given" : line;
}

std::uint8_t to_byte(float value) {
  // A NaN fails both comparisons of clamp; it must not become an arbitrary byte.
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

void write_file(const fs::path& file, const fs::path& named, const OIIO::ImageSpec& spec,
                const void* pixels) {
  const auto output = OIIO::ImageOutput::create(file.string());
  if (!output) throw InputError(fmt::format("{}: {}", named.string(), one_line(OIIO::geterror())));
  if (!output->open(file.string(), spec) || !output->write_image(spec.format, pixels) || !output->close()) {
    throw InputError(fmt::format("{}: cannot be written: {}", named.string(), one_line(output->geterror())));
  }
}

/// The format is chosen by the extension alone: OpenImageIO would otherwise try every reader it has on the
/// file.
std::unique_ptr<OIIO::ImageInput> reader_for(const fs::path& path) {
  const std::string kind = extension(path);
  for (const char* known : {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr"}) {
    if (kind == known) return OIIO::ImageInput::create(kind.substr(1));
  }
  throw InputError(
      fmt::format("{}: not a picture that pelage reads; PNG, JPEG, TIFF and EXR are", path.string()));
}

/// PNG and JPEG end with a marker. OpenImageIO returns a truncated JPEG as a picture with grey in it.
void require_end(const fs::path& path) {
  using namespace std::string_literals;
  const std::string kind = extension(path);
  const std::string marker = kind == ".png" ? "IEND\xae\x42\x60\x82"s : "\xff\xd9"s;
  if (kind != ".png" && kind != ".jpg" && kind != ".jpeg") return;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  // Some writers pad behind the marker.
  std::string tail(static_cast<std::size_t>(std::clamp<std::streamoff>(size, 0, 1024)), '\0');
  file.seekg(-static_cast<std::streamoff>(tail.size()), std::ios::end);
  file.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  if (!file || tail.find(marker) == std::string::npos) {
    throw InputError(
        fmt::format("{}: damaged picture: the file ends before the picture does", path.string()));
  }
}

}  // namespace

void check_picture_path(const fs::path& path) {
  const std::string kind = extension(path);
  if (kind != ".png" && kind != ".exr" && kind != ".tif" && kind != ".tiff") {
    throw InputError(fmt::format("{}: a picture is written as .png, .exr or .tif", path.string()));
  }
  require_place(path);
}

void write_picture(const fs::path& path, const Picture& picture) {
  check_picture_path(path);
  if (picture.width < 1 || picture.height < 1 || picture.width > most_pixels_per_side ||
      picture.height > most_pixels_per_side ||
      picture.pixel.size() !=
          static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height)) {
    throw InputError(fmt::format("{}: a picture of {} x {} pixels cannot be written; each side is 1 to {}",
                                 path.string(), picture.width, picture.height, most_pixels_per_side));
  }
  write_atomically(path, [&](const fs::path& temporary) {
    if (extension(path) == ".png") {
      OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
      spec.attribute("oiio:ColorSpace", "sRGB");
      write_file(temporary, path, spec, rgb_bytes(picture).data());
    } else {
      OIIO::ImageSpec spec(picture.width, picture.height, 4, OIIO::TypeDesc::FLOAT);
      spec.attribute("compression", "zip");
      write_file(temporary, path, spec, picture.pixel.data());
    }
  });
}

Picture read_picture(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw InputError(fmt::format("{}: there is no such file", path.string()));
  if (!fs::is_regular_file(path, error)) throw InputError(fmt::format("{}: not a file", path.string()));
  const auto input = reader_for(path);
  OIIO::ImageSpec spec;
  if (!input || !input->open(path.string(), spec)) {
    const std::string reason = input ? input->geterror() : OIIO::geterror();
    throw InputError(fmt::format("{}: not a readable picture: {}", path.string(), one_line(reason)));
  }
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.width > most_pixels_per_side ||
      spec.height > most_pixels_per_side || spec.nchannels < 1 || spec.nchannels > 32) {
    throw InputError(
        fmt::format("{}: {} x {} pixels of {} channels; each side is 1 to {}, at most 32 channels",
                    path.string(), spec.width, spec.height, spec.nchannels, most_pixels_per_side));
  }
  // A few bytes of header must not claim gigabytes: deflate, the densest of these codecs, reaches 1 to 1032.
  if (spec.image_bytes() / densest_codec > fs::file_size(path, error)) {
    throw InputError(fmt::format("{}: damaged picture: the file is too small for {} x {} pixels",
                                 path.string(), spec.width, spec.height));
  }
  require_end(path);
  const auto pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  const int channels = std::min(spec.nchannels, 4);
  std::vector<float> values(pixels * static_cast<std::size_t>(channels));
  const bool read = input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data());
  // A truncated TIFF reads "well" and leaves only a message.
  const std::string complaint = input->geterror();
  if (!read || !complaint.empty()) {
    throw InputError(fmt::format("{}: damaged picture: {}", path.string(), one_line(complaint)));
  }

  Picture picture{spec.width, spec.height, std::vector<glm::vec4>(pixels)};
  const bool grey = channels < 3;
  const bool alpha = channels == 2 || channels == 4;
  for (std::size_t i = 0; i < pixels; ++i) {
    const float* value = &values[i * static_cast<std::size_t>(channels)];
    picture.pixel[i] =
        glm::vec4(value[0], value[grey ? 0 : 1], value[grey ? 0 : 2], alpha ? value[channels - 1] : 1.0f);
  }
  return picture;
}

}  // namespace pelage
