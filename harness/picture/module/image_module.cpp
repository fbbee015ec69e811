// The image module is a separate shared library that uses OpenImageIO. OpenImageIO loads 250 libraries. If
// pelage itself were linked to OpenImageIO, every start of pelage would take a third of a second longer.
#include "harness/picture/image_module.hpp"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

#include "harness/error.hpp"
#include "harness/picture/image_io.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

// Upper bound of the compression ratio (decompressed bytes / file bytes) of all codecs that pelage reads. A
// file whose header gives a higher ratio is damaged.
constexpr std::uintmax_t densest_codec = 4096;

// Largest number of pixels of a picture that pelage reads: 8192 x 8192. Reading takes 32 bytes of memory per
// pixel.
constexpr std::uint64_t most_pixels_read = std::uint64_t(1) << 26;

// Initialized when the module is loaded. OpenImageIO and OpenEXR must not start threads: read() runs in a
// child process (see read_picture()), in which the threads of the parent process do not exist.
[[maybe_unused]] const bool without_threads =
    OIIO::attribute("threads", 1) && OIIO::attribute("exr_threads", -1);  // -1: OpenEXR starts no threads

/// Returns the first line of OpenImageIO's message. OpenImageIO repeats this line for every scanline.
std::string one_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "no reason given" : line;
}

/// Returns the number that the bytes from `at` on contain, the most significant byte first.
std::size_t number_at(std::string_view bytes, std::size_t at, std::size_t count) {
  std::size_t number = 0;
  for (const char byte : bytes.substr(at, count)) number = number << 8 | static_cast<unsigned char>(byte);
  return number;
}

/// Returns whether a PNG file has its last chunk, IEND. A chunk has a length, a name of four bytes, its data
/// and a checksum.
bool png_ends(std::string_view bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size(); at += 12 + number_at(bytes, at, 4))
    if (bytes.substr(at + 4, 4) == "IEND") return true;
  return false;
}

/// Returns whether a JPEG file has the marker of its end, FF D9, outside of a segment, which may contain a
/// smaller picture. In the data between segments, FF 00 is a byte FF, and FF D0 to FF D7 are restarts.
bool jpeg_ends(std::string_view bytes) {
  for (std::size_t at = 2; at + 1 < bytes.size();) {
    const auto marker = static_cast<unsigned char>(bytes[at + 1]);
    if (bytes[at] != '\xff' || marker == 0xff) {
      ++at;
    } else if (marker == 0xd9) {
      return true;
    } else if (marker <= 1 || (marker >= 0xd0 && marker <= 0xd8)) {
      at += 2;
    } else {
      at += 2 + number_at(bytes, at + 2, 2);
    }
  }
  return false;
}

/// Throws InputError if a PNG or JPEG file ends before its picture. This check is necessary because
/// OpenImageIO returns a truncated JPEG as a picture with grey areas. Bytes after the picture are ignored;
/// telephones write videos there.
void require_end(const fs::path& file, const std::string& kind) {
  if (kind != "png" && kind != "jpeg") return;
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!(kind == "png" ? png_ends(bytes) : jpeg_ends(bytes)))
    throw InputError(
        fmt::format("{}: damaged picture: the file ends before the end of the picture", file.string()));
}

/// Throws InputError if a side of the picture is larger than pelage reads.
void require_sides(const fs::path& file, int width, int height, int channels) {
  if (width < 1 || height < 1 || width > most_pixels_per_side || height > most_pixels_per_side ||
      channels < 1 || channels > 32)
    throw InputError(fmt::format(
        "{}: {} x {} pixels with {} channels; pelage reads 1 to {} pixels per side, and at most 32 channels",
        file.string(), width, height, channels, most_pixels_per_side));
  if (std::uint64_t(width) * std::uint64_t(height) > most_pixels_read)
    throw InputError(fmt::format("{}: {} x {} pixels; pelage reads pictures of at most {} pixels",
                                 file.string(), width, height, most_pixels_read));
}

/// Places the pixels as a viewer does: those of an EXR file's data window in its display window, with 0
/// around them; those of the other formats turned by the orientation that the file states. Changes the sides
/// in `spec`.
void place(OIIO::ImageSpec& spec, const std::string& kind, int channels, std::vector<float>& values) {
  OIIO::ImageSpec own(spec.width, spec.height, channels, OIIO::TypeDesc::FLOAT);
  OIIO::ImageBuf to;
  if (kind == "openexr") {
    if (spec.roi() == spec.roi_full()) return;
    to.reset(OIIO::ImageSpec(spec.full_width, spec.full_height, channels, OIIO::TypeDesc::FLOAT));
    OIIO::ImageBufAlgo::zero(to);
    OIIO::ImageBufAlgo::paste(to, spec.x - spec.full_x, spec.y - spec.full_y, 0, 0,
                              OIIO::ImageBuf(own, values.data()));
  } else {
    const int orientation = spec.get_int_attribute("Orientation", 1);
    if (orientation == 1) return;
    own.attribute("Orientation", orientation);
    const OIIO::ImageBuf stored(own, values.data());
    // OpenImageIO 2.4 takes 5 for 7 and 7 for 5.
    if (orientation == 5 || orientation == 7)
      to = OIIO::ImageBufAlgo::transpose(stored);
    else
      to = OIIO::ImageBufAlgo::reorient(stored);
    if (orientation == 7) to = OIIO::ImageBufAlgo::rotate180(to);
  }
  std::vector<float> placed(to.roi().npixels() * std::size_t(channels));
  to.get_pixels(to.roi(), OIIO::TypeDesc::FLOAT, placed.data());
  values = std::move(placed);
  spec.width = to.roi().width();
  spec.height = to.roi().height();
}

/// Returns the channels of red, green and blue. An EXR file may have others before and after them.
std::array<int, 3> colour_channels(const OIIO::ImageSpec& spec, const std::string& kind,
                                   const fs::path& file) {
  if (kind != "openexr") return spec.nchannels < 3 ? std::array{0, 0, 0} : std::array{0, 1, 2};
  const auto place = [&](const char* name) { return spec.channelindex(name); };
  const std::array<int, 3> colour{place("R"), place("G"), place("B")},
      grey{place("Y"), place("Y"), place("Y")};
  const std::array<int, 3>& chosen = grey[0] < 0 ? colour : grey;
  if (*std::ranges::min_element(chosen) < 0)
    throw InputError(fmt::format("{}: the picture has neither the channels R, G and B nor Y", file.string()));
  return chosen;
}

/// Returns Picture::gamma. Screens show values whose gamma is about 2.2.
float gamma_of(const OIIO::ImageSpec& spec, const std::string& kind) {
  if (kind != "png") return 0;
  const bool linear = OIIO::Strutil::iequals(spec.get_string_attribute("oiio:ColorSpace"), "linear");
  const float gamma = linear ? 1 : spec.get_float_attribute("oiio:Gamma", 0);
  return gamma > 0 && std::abs(gamma - 2.2f) > 0.1f ? gamma : 0;
}

Picture read(const fs::path& file, const std::string& kind) {
  const auto input = OIIO::ImageInput::create(kind);
  // Without this hint, OpenImageIO multiplies the colours of PNG and TIFF files by alpha.
  OIIO::ImageSpec spec, hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  if (!input || !input->open(file.string(), spec, hints)) {
    const std::string reason = input ? input->geterror() : OIIO::geterror();
    throw InputError(fmt::format("{}: not a readable picture: {}", file.string(), one_line(reason)));
  }
  require_sides(file, spec.width, spec.height, spec.depth > 1 ? 0 : spec.nchannels);
  if (kind == "openexr") require_sides(file, spec.full_width, spec.full_height, spec.nchannels);
  // A damaged header of a small file must not make the reader allocate gigabytes. Of the codecs that pelage
  // reads, deflate has the highest compression ratio, at most 1032. The limit densest_codec is higher, so
  // every undamaged file passes this test.
  std::error_code error;
  if (std::max(spec.image_bytes(), spec.tile_bytes()) / densest_codec > fs::file_size(file, error)) {
    throw InputError(fmt::format("{}: damaged picture: the file is too small for {} x {} pixels",
                                 file.string(), spec.width, spec.height));
  }
  require_end(file, kind);
  const auto pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  const int channels = spec.nchannels;
  std::vector<float> values(pixels * static_cast<std::size_t>(channels));
  const bool read = input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data());
  // For a truncated TIFF, read_image() returns true, but geterror() returns an error message.
  const std::string complaint = input->geterror();
  if (!read || !complaint.empty())
    throw InputError(fmt::format("{}: damaged picture: {}", file.string(), one_line(complaint)));

  place(spec, kind, channels, values);
  Picture picture{spec.width, spec.height, std::vector<glm::vec4>(values.size() / std::size_t(channels)),
                  gamma_of(spec, kind)};
  const std::array<int, 3> colour = colour_channels(spec, kind, file);
  for (std::size_t i = 0; i < picture.pixel.size(); ++i) {
    const float* value = &values[i * static_cast<std::size_t>(channels)];
    picture.pixel[i] = glm::vec4(value[colour[0]], value[colour[1]], value[colour[2]],
                                 spec.alpha_channel < 0 ? 1.0f : value[spec.alpha_channel]);
  }
  return picture;
}

void write_float(const fs::path& file, const std::string& name, const Picture& picture) {
  OIIO::ImageSpec spec(picture.width, picture.height, 4, OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  const auto output = OIIO::ImageOutput::create(file.string());
  if (!output) throw InputError(fmt::format("{}: {}", name, one_line(OIIO::geterror())));
  if (!output->open(file.string(), spec) || !output->write_image(spec.format, picture.pixel.data()) ||
      !output->close()) {
    throw InputError(fmt::format("{}: cannot be written: {}", name, one_line(output->geterror())));
  }
}

void write_webp(const fs::path& file, const Picture& picture, int quality) {
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("compression", fmt::format("webp:{}", quality));
  std::vector<unsigned char> bytes;
  bytes.reserve(picture.pixel.size() * 3);
  for (const glm::vec4& pixel : picture.pixel)
    for (int channel = 0; channel < 3; ++channel)
      bytes.push_back(static_cast<unsigned char>(std::clamp(pixel[channel], 0.0f, 1.0f) * 255.0f + 0.5f));
  const auto output = OIIO::ImageOutput::create(file.string());
  if (!output) throw InputError(fmt::format("WebP: {}", one_line(OIIO::geterror())));
  if (!output->open(file.string(), spec) || !output->write_image(spec.format, bytes.data()) ||
      !output->close()) {
    throw InputError(fmt::format("WebP: {}", one_line(output->geterror())));
  }
}

/// Returns the bounds of the painted text in pixels, relative to the left end of its baseline.
OIIO::ROI text_bounds(const TextLine& line, const std::string& text, int size) {
  const OIIO::ROI bounds = OIIO::ImageBufAlgo::text_size(text, size, line.font.string());
  if (!bounds.defined())
    throw InputError(
        fmt::format("{}: not a readable font; give a TrueType or OpenType file", line.font.string()));
  return bounds;
}

std::string text_bytes(const TextLine& line, int side) {
  // A font's nominal size is not the height of its letters. The height of H at a known size gives the scale.
  constexpr int known_size = 512;
  const int known_height = text_bounds(line, "H", known_size).height();
  if (known_height < 1) throw InputError(fmt::format("{}: the font has no letter H", line.font.string()));
  const int size = std::max(1, int(known_size * line.height * side / known_height + 0.5));
  const OIIO::ROI bounds = text_bounds(line, line.text, size);
  const int x = int(std::lround(line.u * side - 0.5 * (bounds.xbegin + bounds.xend)));
  const int y = int(std::lround((1.0 - line.v) * side - 0.5 * (bounds.ybegin + bounds.yend)));
  if (bounds.width() < 1 || bounds.height() < 1)
    throw InputError(fmt::format("wetness.text: {} has no letters for this text", line.font.string()));
  if (x + bounds.xbegin < 0 || y + bounds.ybegin < 0 || x + bounds.xend > side || y + bounds.yend > side)
    throw InputError(fmt::format(
        "wetness.text: the text is {:.3f} wide and {:.3f} high in UV, and leaves the unit square; give a smaller wetness.text_height, or another wetness.text_u or wetness.text_v",
        double(bounds.width()) / side, double(bounds.height()) / side));
  OIIO::ImageBuf picture(OIIO::ImageSpec(side, side, 1, OIIO::TypeDesc::UINT8));
  OIIO::ImageBufAlgo::zero(picture);
  if (!OIIO::ImageBufAlgo::render_text(picture, x, y, line.text, size, line.font.string()))
    throw InputError(
        fmt::format("{}: the text cannot be painted: {}", line.font.string(), one_line(picture.geterror())));
  std::string bytes(std::size_t(side) * std::size_t(side), '\0');
  picture.get_pixels(picture.roi(), OIIO::TypeDesc::UINT8, bytes.data());
  return bytes;
}

}  // namespace
}  // namespace pelage

extern "C" {
extern const pelage::ImageModule pelage_image_module;
const pelage::ImageModule pelage_image_module{pelage::read, pelage::write_float, pelage::write_webp,
                                              pelage::text_bytes};
}
