// Tests statements of a paper about its figures with our measurements.
#pragma once
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"

namespace pelage {

enum class Held { yes, no, not_measured };
std::string_view to_text(Held held);  ///< returns "holds", "does not hold" or "not measured"

struct Claim {
  std::string device;
  std::string sentence;  ///< the paper's own words
  std::string source;    ///< the place in the paper
  std::string reading;   ///< the number that is computed in every cell, and its limit
  Held held = Held::not_measured;
  std::string found;  ///< the range of the numbers, and the cell with the worst number
};

/// Tests the statements of Banisch and Wüthrich on Figures 9 to 11 for each device. Uses the rows of
/// banisch2006-update-time that are ok and have no overrides; returns no claims if there are none. A claim is
/// measured if every cell that it covers has a time. Frame times are wall times; simulation times come from
/// the device's timer.
std::vector<Claim> claims_of(const std::vector<FoundRow>& rows);

std::string csv_of(const std::vector<Claim>& claims);
std::string text_of(const std::vector<Claim>& claims);
std::string html_of(const std::vector<Claim>& claims);

}  // namespace pelage
