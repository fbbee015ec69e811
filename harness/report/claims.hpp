// What a paper says of its own figures, held against ours: does it hold here?
#pragma once
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"

namespace pelage {

enum class Held { yes, no, not_measured };
std::string_view to_text(Held held);  ///< "holds", "does not hold", "not measured"

struct Claim {
  std::string device;
  std::string sentence;  ///< as the paper has it
  std::string source;
  std::string reading;  ///< the number that is asked of every cell, and its limit
  Held held = Held::not_measured;
  std::string found;  ///< the numbers' range and the cell that is farthest on the wrong side
};

/// The sentences of Banisch and Wüthrich on Figures 9 to 11, per device, from the rows of
/// banisch2006-update-time that are ok and the experiment's own. A claim is measured once every cell that it
/// speaks of is there. Frames by the wall clock, simulation by the device's timer. Empty without such rows.
std::vector<Claim> claims_of(const std::vector<FoundRow>& rows);

std::string csv_of(const std::vector<Claim>& claims);
std::string text_of(const std::vector<Claim>& claims);
std::string html_of(const std::vector<Claim>& claims);

}  // namespace pelage
