// Compares two pictures of the same fur, and selects windows for the comparison. Measures the height of a
// model in a picture, and the wet share of a model's surface.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "harness/mesh/mesh.hpp"
#include "harness/picture/picture.hpp"

namespace pelage {

/// Differences between two pictures over the fur pixels. A fur pixel has an alpha above 0 in at least one of
/// the two pictures. The values exclude background pixels, because these are always equal and would improve
/// the values.
struct Agreement {
  double psnr = 0;  ///< PSNR of red, green and blue in dB with peak 1; 200 if the pictures are equal
  double psnr_without_flips = 0;  ///< PSNR without the pixels counted in `flips`; 0 if no pixel remains
  /// 99.9th percentile of the pixels' differences. The difference of a pixel is the largest absolute
  /// difference of its four channels.
  double p999 = 0;
  /// Largest absolute difference of a channel over all fur pixels. A difference that is not finite counts as
  /// 10^6.
  double worst = 0;
  std::size_t pixels = 0;  ///< number of fur pixels compared
  std::size_t flips = 0;   ///< number of pixels with a channel that differs by more than tolerance::flip
  int worst_x = 0, worst_y = 0;
  double flip_share() const { return pixels > 0 ? double(flips) / double(pixels) : 0; }
};

/// Compares the fur pixels inside `windows`, or all fur pixels if `windows` is empty. Pixels in several
/// windows count once; parts of a window outside the picture are ignored. Throws InputError if the sizes
/// differ.
Agreement compare(const Picture& a, const Picture& b, const std::vector<Window>& windows = {});

/// Returns whether two pictures count as equal. Three conditions must hold:
/// - the PSNR is at least tolerance::picture_psnr;
/// - p999, the 99.9th percentile of the pixels' differences, is at most tolerance::flip;
/// - flips / pixels, the share of flipped pixels among the fur pixels, is at most tolerance::flip_share.
/// Returns false if there is no fur pixel, because an empty comparison proves nothing.
bool within(const Agreement& agreement);

/// Returns `count` different windows of side x side pixels, or fewer if there are fewer candidates.
/// The cells of a grid over the picture are candidates if they contain a fur pixel or are adjacent to a cell
/// that contains a fur pixel. The adjacent cells reveal fur that is missing at the silhouette. `seed`
/// determines the choice. Windows are sorted by row, then by column.
std::vector<Window> fur_windows(const Picture& picture, std::size_t count, int side, std::uint32_t seed);

/// Returns the mean structural similarity (SSIM) of the lumas of two pictures (Wang, Bovik, Sheikh and
/// Simoncelli, Image Quality Assessment, 2004, Eq. 13, with the constants K1 = 0.01, K2 = 0.03 and the peak
/// 1): 1 if they are equal, less otherwise. The windows are squares of 8 x 8 pixels with equal weights, four
/// pixels apart; windows without a fur pixel are left out. The luma is that of Rec. 601, clamped to 0..1.
/// Returns 1 if there is no fur pixel. Throws InputError if the sizes differ.
double ssim(const Picture& a, const Picture& b);

/// Returns the share of the picture's pixel rows that contain fur, 0..1.
double model_height(const Picture& picture);

/// Returns the area of the triangles whose mask texel is wet, as a share of the mesh's area, 0..1. `mask` has
/// side x side texels. A texel (c_u, c_v, r, rho) contains the centre, the radius and the wetness of a clump.
/// A texel is wet if rho is above 0. The mask texel of a triangle is the texel at the mean of the triangle's
/// three UV positions.
double wet_share(const Mesh& mesh, const std::vector<glm::vec4>& mask, int side);

}  // namespace pelage
