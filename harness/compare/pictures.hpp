// What a picture is held to: against the reference, against a picture whose textures somebody else filtered,
// and between two mappings of one device.
#pragma once
#include <string>
#include <vector>

#include "harness/compare/check.hpp"
#include "harness/compare/metrics.hpp"

namespace pelage {

/// Fur pixels (at least one), psnr, p99.9, flips (their share): within() of the agreement, one check each.
std::vector<Check> picture_checks(const std::string& against, const Agreement& agreement);

/// Fur pixels (at least one) and psnr of at least tolerance::other_filter_psnr: for the OpenGL baseline.
std::vector<Check> other_filter_checks(const std::string& against, const Agreement& agreement);

/// Two pictures of one device: no pixel is covered in one only, no channel differs by more than
/// tolerance::mapping_difference. Throws InputError when the sizes differ.
std::vector<Check> mapping_checks(const std::string& against, const Picture& ours, const Picture& other);

}  // namespace pelage
