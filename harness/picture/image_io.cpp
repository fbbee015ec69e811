#include "harness/picture/image_io.hpp"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/atomic_file.hpp"
#include "harness/error.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

std::string extension(const fs::path& path) {
  std::string name = path.extension().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

/// OpenImageIO's own words, on one line.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.empty() ? "no reason given" : text;
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

}  // namespace

void write_picture(const fs::path& path, const Picture& picture) {
  const std::string kind = extension(path);
  const bool png = kind == ".png";
  if (!png && kind != ".exr" && kind != ".tif" && kind != ".tiff") {
    throw InputError(fmt::format("{}: a picture is written as .png, .exr or .tif", path.string()));
  }
  if (picture.width < 1 || picture.height < 1 || picture.width > most_pixels_per_side ||
      picture.height > most_pixels_per_side ||
      picture.pixel.size() !=
          static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height)) {
    throw InputError(fmt::format("{}: a picture of {} x {} pixels cannot be written; each side is 1 to {}",
                                 path.string(), picture.width, picture.height, most_pixels_per_side));
  }
  write_atomically(path, [&](const fs::path& temporary) {
    if (png) {
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
  const auto pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  const int channels = std::min(spec.nchannels, 4);
  std::vector<float> values(pixels * static_cast<std::size_t>(channels));
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data())) {
    throw InputError(fmt::format("{}: damaged picture: {}", path.string(), one_line(input->geterror())));
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
