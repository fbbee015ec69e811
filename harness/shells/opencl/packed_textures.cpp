#include "harness/shells/opencl/packed_textures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "harness/shells/opencl/params.hpp"

namespace pelage::shells {
namespace {

// Packs four bytes into one word. `a` is the lowest byte.
std::int32_t word_of(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
  return static_cast<std::int32_t>(std::uint32_t(a) | std::uint32_t(b) << 8 | std::uint32_t(c) << 16 |
                                   std::uint32_t(d) << 24);
}

/// The factors of curl.turns of a scene's vertices: multiples of 1 / turn_steps from `first` to `last`.
struct Turns {
  int first, last;
  explicit Turns(const std::vector<float>& shares) {
    const auto [least, most] = std::minmax_element(shares.begin(), shares.end());
    first = int(std::lround(*least * turn_steps));
    last = int(std::lround(*most * turn_steps));
  }
};

/// Appends the number of each vertex's factor of curl.turns, and the cosine and sine of the curl's angle for
/// each layer and factor.
void append_turns(const Scene& scene, const std::vector<float>& shares, std::vector<float>& table) {
  const Turns turns(shares);
  for (const float share : shares) table.push_back(float(std::lround(share * turn_steps) - turns.first));
  for (int n = 0; n < scene.fur.layers; ++n)
    for (int level = turns.first; level <= turns.last; ++level) {
      const float number = scene.curl.turns * (float(level) / turn_steps);
      const double angle = 2.0 * std::numbers::pi * double(number) * ((1.0 + n) / scene.fur.layers);
      table.push_back(float(std::cos(angle)));
      table.push_back(float(std::sin(angle)));
    }
}

}  // namespace

std::vector<std::int32_t> packed_fur(const FurTexture& fur) {
  std::size_t texels = 0;
  for (std::size_t l = 0; l < fur.level.size(); ++l)
    texels += fur.level[l].size() + fur.level[l].size() / std::size_t(fur.size >> l);
  std::vector<std::int32_t> words(texels);
  auto next = words.begin();
  const auto word = [](const auto& here, const auto& below) {
    return word_of(here[0], here[1], below[0], below[1]);
  };
  for (std::size_t l = 0; l < fur.level.size(); ++l) {
    const auto side = std::size_t(fur.size >> l);
    for (std::size_t n = 0; n < std::size_t(fur.layers); ++n) {
      const auto* slice = &fur.level[l][n * side * side];
      for (std::size_t y = 0; y < side; ++y) {
        const auto *here = slice + y * side, *below = slice + (y + 1) % side * side;
        for (std::size_t x = 0; x < side; ++x) *next++ = word(here[x], below[x]);
        *next++ = word(here[0], below[0]);
      }
    }
  }
  return words;
}

std::vector<std::int32_t> packed_coat(const CoatTexture& coat) {
  const auto side = std::size_t(coat.size);
  std::vector<std::int32_t> words;
  words.reserve(2 * (side + 2) * (side + 2));
  for (std::size_t y = 0; y < side + 2; ++y) {
    const auto *here = &coat.texel[(y + side - 1) % side * side], *below = &coat.texel[y % side * side];
    for (std::size_t x = 0; x < side + 2; ++x) {
      const auto &t = here[(x + side - 1) % side], &u = below[(x + side - 1) % side];
      words.push_back(word_of(t[0], t[1], u[0], u[1]));
      words.push_back(word_of(t[2], 0, u[2], 0));
    }
  }
  return words;
}

void place_maps(const FrameInput& input, const Geometry& geometry, RasterParams& params) {
  int end = LAYER_COLUMNS * params.layers;
  if (!geometry.turns.empty()) {
    const Turns turns(geometry.turns);
    params.turn_levels = turns.last - turns.first + 1;
    params.turn_points = end;
    params.turn_angles = end + int(geometry.turns.size());
    end = params.turn_angles + 2 * params.turn_levels * params.layers;
  }
  params.density = input.scene.fur.density;
  params.density_width = input.style.density.width;
  params.density_height = input.style.density.height;
  params.density_map = end;
}

std::vector<float> styled_layer_table(const FrameInput& input, const Geometry& geometry) {
  std::vector<float> table = layer_table(input.scene);
  if (!geometry.turns.empty()) append_turns(input.scene, geometry.turns, table);
  const std::vector<float>& density = input.style.density.value;
  table.insert(table.end(), density.begin(), density.end());
  return table;
}

}  // namespace pelage::shells
