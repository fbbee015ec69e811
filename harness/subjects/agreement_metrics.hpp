// Metrics of a row that help to find the cause of a failed check of the picture.
#pragma once
#include "harness/compare/metrics.hpp"
#include "harness/record/row.hpp"

namespace pelage {

inline void add_agreement(Row& row, const Agreement& agreement) {
  row.metrics["worst_difference"] = {agreement.worst, "1"};
  row.metrics["flips"] = {double(agreement.flips), "pixels"};
  row.metrics["psnr_without_flips"] = {agreement.psnr_without_flips, "dB"};
}

}  // namespace pelage
