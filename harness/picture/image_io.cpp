#include "harness/picture/image_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "harness/atomic_file.hpp"
#include "harness/error.hpp"
#include "harness/isolated/isolated.hpp"
#include "harness/picture/image_module.hpp"
#include "harness/picture/png.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

std::string extension(const fs::path& path) {
  std::string name = path.extension().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

// Memory for the largest picture: 48 bytes per pixel of 8192 x 8192, and the decoder's own memory.
constexpr Limits limits{
    .memory = std::uint64_t(6) << 30, .time = std::chrono::seconds(120), .what = "picture"};

// Converts a picture to bytes and back, to pass it from the process that reads the file.
std::string encoded(const Picture& picture) {
  std::string bytes;
  bytes.reserve(2 * sizeof(int) + picture.pixel.size() * sizeof(glm::vec4));
  for (const int side : {picture.width, picture.height})
    bytes.append(reinterpret_cast<const char*>(&side), sizeof side);
  bytes.append(reinterpret_cast<const char*>(picture.pixel.data()), picture.pixel.size() * sizeof(glm::vec4));
  return bytes;
}

Picture decoded(const std::string& bytes) {
  Picture picture;
  std::memcpy(&picture.width, bytes.data(), sizeof(int));
  std::memcpy(&picture.height, bytes.data() + sizeof(int), sizeof(int));
  picture.pixel.resize((bytes.size() - 2 * sizeof(int)) / sizeof(glm::vec4));
  std::memcpy(picture.pixel.data(), bytes.data() + 2 * sizeof(int), picture.pixel.size() * sizeof(glm::vec4));
  return picture;
}

}  // namespace

void check_picture_path(const fs::path& path) {
  const std::string kind = extension(path);
  if (kind != ".png" && kind != ".exr" && kind != ".tif" && kind != ".tiff") {
    throw InputError(fmt::format("{}: a picture is written as .png, .exr or .tif", path.string()));
  }
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
  std::string folder = (fs::temp_directory_path() / "pelage-webp-XXXXXX").string();
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

}  // namespace pelage
