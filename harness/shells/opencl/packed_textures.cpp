#include "harness/shells/opencl/packed_textures.hpp"

#include <cstddef>

namespace pelage::shells {

namespace {

// Packs four bytes into one word. `a` is the lowest byte.
std::int32_t word_of(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
  return static_cast<std::int32_t>(std::uint32_t(a) | std::uint32_t(b) << 8 | std::uint32_t(c) << 16 |
                                   std::uint32_t(d) << 24);
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

}  // namespace pelage::shells
