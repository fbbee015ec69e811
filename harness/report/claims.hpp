// Uses our measurements to test a paper's statements about the paper's figures.
#pragma once
#include <string>
#include <vector>

#include "harness/journal/results_folder.hpp"

namespace pelage {

enum class Held { yes, no, not_measured };
std::string_view to_text(Held held);  ///< returns "holds", "does not hold" or "not measured"

struct Claim {
  std::string device;
  std::string sentence;  ///< the paper's sentence, quoted
  std::string source;    ///< the figure or section that the sentence is about
  /// Says which value is measured for each model, topology and solver, and which limit each value must meet.
  std::string reading;
  Held held = Held::not_measured;
  /// Text with the smallest and the largest measured value over all models, topologies and solvers of the
  /// claim, and with the model, topology and solver of the worst value. The worst value is the largest value
  /// if `reading` says "at most", and the smallest value if `reading` says "at least".
  std::string found;
};

/// Tests the statements of Banisch and Wüthrich on Figures 9 to 11 for each device. Uses the rows of
/// the experiment banisch2006-update-time that are ok and have no overrides. Returns no claims if there are
/// no such rows. A claim is "not measured" if one of the cells that it covers has no time. Frame times are
/// wall times; simulation times come from the device's timer.
std::vector<Claim> claims_of(const std::vector<FoundRow>& rows);

std::string csv_of(const std::vector<Claim>& claims);
std::string text_of(const std::vector<Claim>& claims);
std::string html_of(const std::vector<Claim>& claims);

}  // namespace pelage
