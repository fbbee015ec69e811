// The layout of Cem Yuksel's HAIR files: a header of 128 bytes, and then the arrays that its bits name, in
// the order of the bits: the number of segments of each strand (16 bits each), the points (three floats), the
// widths, the transparencies, and the colours (three floats) of all points. All numbers are little-endian.
#pragma once
#include <bit>
#include <cstdint>

namespace pelage::hair {

static_assert(std::endian::native == std::endian::little);

inline constexpr std::uint32_t has_segments = 1u << 0, has_points = 1u << 1, has_widths = 1u << 2,
                               has_transparencies = 1u << 3, has_colours = 1u << 4;

struct Header {
  char magic[4] = {'H', 'A', 'I', 'R'};
  std::uint32_t strands = 0, points = 0;
  std::uint32_t arrays = 0;    ///< bits of the arrays that follow
  std::uint32_t segments = 0;  ///< of each strand, if the file has no array of them
  float width = 0, transparency = 0, colour[3] = {0, 0, 0};  ///< of all points that have none of their own
  char note[88] = {};
};
static_assert(sizeof(Header) == 128);

}  // namespace pelage::hair
