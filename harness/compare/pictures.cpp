#include "harness/compare/pictures.hpp"

#include "harness/compare/tolerances.hpp"

namespace pelage {

std::vector<Check> picture_checks(const std::string& against, const Agreement& agreement) {
  return {{against, "fur pixels", double(agreement.pixels), 1, true},
          {against, "psnr", agreement.psnr, tolerance::picture_psnr, true},
          {against, "p99.9", agreement.p999, tolerance::flip, false},
          {against, "flips", agreement.flip_share(), tolerance::flip_share, false}};
}

std::vector<Check> other_filter_checks(const std::string& against, const Agreement& agreement) {
  return {{against, "fur pixels", double(agreement.pixels), 1, true},
          {against, "psnr", agreement.psnr, tolerance::other_filter_psnr, true}};
}

std::vector<Check> mapping_checks(const std::string& against, const Picture& ours, const Picture& other) {
  const Agreement agreement = compare(ours, other);
  double covered = 0;
  for (std::size_t i = 0; i < ours.pixel.size(); ++i)
    covered += (ours.pixel[i].w > 0) != (other.pixel[i].w > 0);
  return {{against, "pixels covered in only one picture", covered, 0, false},
          {against, "largest difference", agreement.worst, tolerance::mapping_difference, false}};
}

}  // namespace pelage
