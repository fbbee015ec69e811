// Writes the HTML page of `pelage reproduce`: for each paper, its claims with their verdicts, its tables
// beside the paper's, its figures, and what is missing.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "harness/claims/judge.hpp"
#include "harness/experiment/paper_plan.hpp"
#include "harness/report/report.hpp"

namespace pelage {

/// A paper on the page.
struct PaperPart {
  PaperPlan plan;
  /// The pictures (.png or .svg) of the panels of each figure. An empty path means that there is none.
  std::vector<std::vector<std::filesystem::path>> panels;
};

/// What the page shows.
struct PapersPage {
  std::vector<PaperPart> papers;
  std::vector<claims::Judged> claims;  ///< of all papers; with `smoke`, their verdicts are not shown
  std::vector<std::string> notes;      ///< what failed: an experiment without rows, a picture, ...
  std::string preset;
  bool smoke = false;  ///< the frames are too small and too few to judge claims
};

/// Returns the HTML inside the "body" element, without the scripts. Pictures are compressed, at most
/// `most_width` pixels wide.
std::string papers_body(const std::vector<Report>& reports, const PapersPage& page, int most_width = 480);

/// Writes the page. Throws InputError if the file cannot be written.
void write_papers_page(const std::vector<Report>& reports, const PapersPage& page,
                       const std::filesystem::path& file);

}  // namespace pelage
