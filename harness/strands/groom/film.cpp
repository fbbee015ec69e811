#include "harness/strands/groom/film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/error.hpp"
#include "harness/picture/image_io.hpp"

namespace pelage::strands {
namespace {

constexpr int columns = int(std::tuple_size_v<FilmFrame>), most_rows = 256;

std::uint8_t byte_of(float value) {
  return std::uint8_t(std::lround(255 * std::clamp(double(value), 0.0, 1.0)));
}

Picture picture_of(const std::filesystem::path& path, const std::string& key) {
  try {
    return read_picture(path);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", key, error.what()));
  }
}

}  // namespace

std::vector<FilmFrame> read_film(const std::filesystem::path& path, const std::string& key) {
  const Picture picture = picture_of(path, key);
  if (picture.width != columns || picture.height > most_rows)
    throw InputError(fmt::format("{}: {}: has {} x {} pixels; a film strip has {} columns and 1 to {} rows",
                                 key, path.string(), picture.width, picture.height, columns, most_rows));
  std::vector<FilmFrame> frames;
  for (int y = 0; y < picture.height; ++y) {
    FilmFrame frame;
    for (int x = 0; x < columns; ++x) {
      const glm::vec4 c = picture.at(x, y);
      frame[std::size_t(x)] = {byte_of(c.x), byte_of(c.y), std::uint8_t(255 - byte_of(c.z))};
    }
    frames.push_back(frame);
  }
  return frames;
}

}  // namespace pelage::strands
