// Tests the verdicts on the paper's statements about Figures 9 to 11. The tests use synthetic times that
// lead to each verdict: "holds", "does not hold" and "not measured".
#include "harness/report/claims.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace pelage {
namespace {

/// Returns the row of one cell with frame times of `frame` ms and simulation times of `simulate` ms.
FoundRow cell(const std::string& model, const std::string& topology, const std::string& solver, double frame,
              double simulate) {
  FoundRow found;
  Row& row = found.row;
  row.experiment = "banisch2006-update-time";
  row.case_name = model + " " + topology + " " + solver;
  row.variant = solver;
  row.axes = {{"model", model}, {"dynamics.topology", topology}};
  row.device = "test device";
  for (int i = 0; i < 5; ++i) {
    row.samples["frame"].wall_ms.push_back(frame);
    row.samples["simulate"].event_ms.push_back(simulate);
  }
  return found;
}

std::vector<FoundRow> as_the_paper_says() {
  std::vector<FoundRow> rows;
  for (const char* model : {"banisch-elephant", "banisch-dog", "banisch-grass"})
    for (const char* topology : {"sticks", "prisms", "separable-sticks", "separable-prisms"})
      for (const char* solver : {"explicit-euler", "backward-euler"}) {
        const bool apart = std::string(topology).starts_with("separable");
        rows.push_back(cell(model, topology, solver, apart ? 45 : 40, apart ? 3 : 1));
      }
  return rows;
}

std::vector<Held> verdicts(const std::vector<FoundRow>& rows) {
  std::vector<Held> found;
  for (const Claim& claim : claims_of(rows)) found.push_back(claim.held);
  return found;
}

TEST(Claims, HoldWhereTheTimesAreThePapers) {
  const std::vector<Held> found = verdicts(as_the_paper_says());
  EXPECT_EQ(found, std::vector<Held>(6, Held::yes));
}

// The test replaces one row of the paper's times, so that one claim is false in one cell. Only this claim
// must fail, and its text must name the model of the cell.
TEST(Claims, FailWhereOneCellSpeaksAgainstThem) {
  struct Planted {
    std::size_t claim;
    FoundRow row;
  };
  for (const Planted& planted :
       {Planted{0, cell("banisch-dog", "prisms", "backward-euler", 1.9, 1)},
        Planted{1, cell("banisch-elephant", "sticks", "explicit-euler", 5, 0.4)},
        Planted{2, cell("banisch-dog", "separable-prisms", "explicit-euler", 45, 0.9)},
        Planted{3, cell("banisch-elephant", "separable-sticks", "explicit-euler", 60, 3)},
        Planted{4, cell("banisch-dog", "sticks", "explicit-euler", 40, 2.1)},
        Planted{5, cell("banisch-grass", "separable-prisms", "backward-euler", 40, 4.1)}}) {
    std::vector<FoundRow> rows = as_the_paper_says();
    for (FoundRow& row : rows)
      if (row.row.case_name == planted.row.row.case_name) row = planted.row;
    const std::vector<Claim> found = claims_of(rows);
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_EQ(found[i].held, i == planted.claim ? Held::no : Held::yes)
          << i << ' ' << found[i].sentence << ": " << found[i].found;
    const Claim& failed = found.at(planted.claim);
    EXPECT_NE(failed.found.find(planted.row.row.axes.at("model")), std::string::npos) << failed.found;
    EXPECT_NE(text_of(found).find("does not hold: \"" + failed.sentence), std::string::npos);
  }
}

TEST(Claims, AreNotMeasuredWithoutTheirCells) {
  EXPECT_TRUE(claims_of({}).empty());
  std::vector<FoundRow> rows = as_the_paper_says();
  rows[0].row.status = Status::failed_check;  // row of the elephant on sticks with the explicit solver
  const std::vector<Held> found = verdicts(rows);
  EXPECT_EQ(std::count(found.begin(), found.end(), Held::not_measured), 3);
  rows[1].row.overrides["dynamics.step"] = "0.1";
  EXPECT_EQ(claims_of({rows[0], rows[1]}).size(), 0u);
}

}  // namespace
}  // namespace pelage
