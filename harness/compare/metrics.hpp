// Compares two pictures of the same fur, and selects windows for the comparison.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "harness/picture/picture.hpp"

namespace pelage {

/// Differences of two pictures over the fur pixels, the pixels where the alpha of either picture is above 0.
/// Background pixels would only improve the figures.
struct Agreement {
  double psnr = 0;  ///< dB against a peak of 1, over red, green and blue; 200 if the pictures are equal
  double psnr_without_flips = 0;  ///< PSNR over the pixels that are not flipped; 0 if all are flipped
  /// The 99.9th percentile over the pixels of a pixel's largest |difference| in its four channels.
  double p999 = 0;
  /// The largest |difference| of any channel of any pixel. A difference that is not finite counts as 10^6.
  double worst = 0;
  std::size_t pixels = 0;  ///< number of fur pixels compared
  std::size_t flips = 0;   ///< number of flipped pixels: some channel differs by more than tolerance::flip
  int worst_x = 0, worst_y = 0;
  double flip_share() const { return pixels > 0 ? double(flips) / double(pixels) : 0; }
};

/// Compares the whole pictures, or only the pixels inside `windows`. Pixels in several windows count once;
/// parts of a window outside the picture are ignored. Throws InputError if the sizes differ.
Agreement compare(const Picture& a, const Picture& b, const std::vector<Window>& windows = {});

/// Returns whether two pictures count as equal: PSNR is at least tolerance::picture_psnr, p999 is at most
/// tolerance::flip, and at most the fraction tolerance::flip_share of the pixels is flipped. Returns false if
/// there is no fur pixel, because an empty comparison proves nothing.
bool within(const Agreement& agreement);

/// Returns `count` different windows of side x side pixels, or fewer if there are fewer candidates.
/// Candidates are the cells of a grid that contain a fur pixel or are adjacent to such a cell, so that
/// missing fur at the silhouette is detected. `seed` determines the choice. Windows are sorted by row, then
/// by column.
std::vector<Window> fur_windows(const Picture& picture, std::size_t count, int side, std::uint32_t seed);

}  // namespace pelage
