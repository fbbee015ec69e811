// The checks of a picture: against the reference, against a picture with different texture filtering, and
// against a picture that another rasterizer mapping (tile, workgroup or pixel) drew on the same device.
#pragma once
#include <string>
#include <vector>

#include "harness/compare/metrics.hpp"
#include "harness/record/check.hpp"

namespace pelage {

/// Returns four checks of the difference between two pictures: the number of fur pixels (at least one), the
/// PSNR, the 99.9th percentile of the pixel differences, and the share of flipped pixels (see
/// tolerance::flip). within() tests the same conditions.
std::vector<Check> picture_checks(const std::string& against, const Agreement& agreement);

/// Returns the checks of the OpenGL baseline's picture: the number of fur pixels (at least one), and psnr (at
/// least tolerance::other_filter_psnr).
std::vector<Check> other_filter_checks(const std::string& against, const Agreement& agreement);

/// Returns the checks of two pictures that different mappings drew on one device: the same
/// pixels must be covered in both pictures, and no channel may differ by more than
/// tolerance::mapping_difference. Throws InputError if the sizes differ.
std::vector<Check> mapping_checks(const std::string& against, const Picture& ours, const Picture& other);

}  // namespace pelage
