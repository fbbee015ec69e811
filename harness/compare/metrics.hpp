// How far two pictures of the same fur are apart, and where to look.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "harness/picture/picture.hpp"

namespace pelage {

/// Over the fur pixels: those where either picture's alpha is above 0. Background would only flatter the
/// figures.
struct Agreement {
  double psnr = 0;  ///< dB against a peak of 1, over red, green and blue; 200 when they are equal
  double psnr_without_flips = 0;  ///< the same over the pixels that are not flipped; 0 when there are none
  double p999 = 0;         ///< 99.9th percentile over pixels of the largest |difference| of the four channels
  double worst = 0;        ///< the largest of those differences; one that is not finite counts as 10^6
  std::size_t pixels = 0;  ///< fur pixels compared
  std::size_t flips = 0;   ///< of those the flipped ones: some channel differs by more than tolerance::flip
  int worst_x = 0, worst_y = 0;
  double flip_share() const { return pixels > 0 ? double(flips) / double(pixels) : 0; }
};

/// Compares the whole pictures, or only the pixels inside `windows` (overlaps count once; parts outside the
/// picture are ignored). Throws InputError when the sizes differ.
Agreement compare(const Picture& a, const Picture& b, const std::vector<Window>& windows = {});

/// What "the same picture" means here (harness/compare/tolerances.hpp): PSNR at least
/// tolerance::picture_psnr, p999 at most tolerance::flip, and at most tolerance::flip_share of the pixels
/// flipped. False when no fur pixel was compared: an empty comparison proves nothing.
bool within(const Agreement& agreement);

/// `count` different windows of side x side pixels (fewer when the picture has no more), drawn by `seed` from
/// the cells of a side x side grid that hold a fur pixel or touch a cell that does, so that fur missing at
/// the silhouette is looked for too. The order is by rows.
std::vector<Window> fur_windows(const Picture& picture, std::size_t count, int side, std::uint32_t seed);

}  // namespace pelage
