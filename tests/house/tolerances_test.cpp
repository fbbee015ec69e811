// Tests that only harness/compare/tolerances.hpp defines tolerances. A tolerance is a number that decides
// whether a result is accepted.
#include <fmt/format.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/house/rules.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace fs = std::filesystem;
using pelage::house::root;

namespace {

/// Returns the lines of a source file that define a tolerance. `path` is relative to the repository.
std::vector<std::string> written_tolerances(const std::string& path, const std::string& text) {
  // contradiction.hpp has the weakest limits of rows of every version, which belong to the file format.
  if (path == "harness/compare/tolerances.hpp" || path == "harness/record/contradiction.hpp") return {};
  // In a line that constructs a Check, this expression matches a limit that is written as a number. Two kinds
  // of limits are not tolerances: a limit of 0, and the limit of a count. A limit is the limit of a count if
  // the checked value before it has the form double(...).
  static const std::regex limit(R"((, double\([\w.()]*\))?,\s*([0-9][-+0-9.e /]*)\s*,\s*(true|false)\s*\})");
  static const std::regex constant(
      R"(constexpr (double|float) \w*(psnr|error|tolerance|difference|residual)\w* = *[0-9])");
  static const std::regex compared(R"([<>]=?\s*[0-9.]+e-[1-6]\b)");
  static const std::regex expected(
      R"(EXPECT_L[TE]\(.*\b(rms|percentile_99|worst|p999)\b, *[0-9]|EXPECT_GE\(.*\bpsnr, *[0-9]|)"
      R"(EXPECT_L[TE]\((largest_difference|error)\b.*[0-9]e-[0-9] \* double\(fur_length\))");
  const bool harness = path.starts_with("harness/"), tests = path.starts_with("tests/");
  bool accepts = false;  // true: code in this folder decides whether results are accepted
  for (const char* folder : {"compare", "commands", "subjects", "tuning", "springs/studies"})
    accepts = accepts || path.starts_with(fmt::format("harness/{}/", folder));
  std::vector<std::string> found;
  int number = 0;
  for (const std::string& line : pelage::test::lines_of(text)) {
    ++number;
    std::smatch match;
    const bool check =
        harness && std::regex_search(line, match, limit) && match[2] != "0" && !match[1].matched;
    if (check || std::regex_search(line, constant) || (accepts && std::regex_search(line, compared)) ||
        (tests && std::regex_search(line, expected)))
      found.push_back(fmt::format("{}:{}: {}", path, number, line));
  }
  return found;
}

}  // namespace

TEST(Tolerances, StandInOnePlace) {
  std::size_t files = 0;
  for (const char* folder : {"harness", "tests", "bench"})
    for (const fs::path& file : pelage::test::files_below(root / folder, "pp")) {
      const std::string path = file.lexically_relative(root).generic_string();
      if (path.starts_with("tests/house/")) continue;
      ++files;
      for (const std::string& line : written_tolerances(path, pelage::test::text_of(file)))
        ADD_FAILURE() << line;
    }
  EXPECT_GT(files, 200u);
}

TEST(Tolerances, PlantedOnesAreFound) {
  const std::pair<const char*, const char*> planted[] = {
      {"harness/commands/check.cpp", "constexpr double most_tip_error = 1e-3, usual_tip_error = 1e-5;"},
      {"harness/subjects/opengl.cpp", "constexpr double least_psnr = 55.0;  // dB"},
      {"tests/shells/opengl/opengl_test.cpp", "constexpr double least_psnr = 55.0;"},
      {"harness/compare/checks.cpp", R"(  return {{against, "worst", found.worst, 1e-4, false}};)"},
      {"harness/springs/studies/duel.cpp", R"(        {"reference", "residual", left, 1e-3, false},)"},
      {"harness/compare/checks.cpp",
       R"({"masses", "rms error / L0", std::sqrt(square / double(error.size())), 1e-3, false},)"},
      {"harness/compare/checks.cpp", R"(  {"reference", "psnr", all.psnr, 60.0, true},)"},
      {"harness/commands/check.cpp", R"({"mappings", name, compare(a, b).worst, 1.0 / 255.0, false}};)"},
      {"harness/tuning/contenders.cpp", "bad = bad || !(std::abs(a - b) <= 1e-5);"},
      {"tests/portability/pictures_test.cpp", "EXPECT_GE(with_here.psnr, 60) << describe(with_here);"},
      {"tests/portability/pictures_test.cpp", "EXPECT_LE(with_here.worst, 1.0 / 255) << x;"},
      {"tests/springs/opencl/steps_test.cpp", "EXPECT_LT(error.rms, 1e-3) << name(solver);"},
      {"tests/springs/opencl/steps_test.cpp",
       "EXPECT_LT(largest_difference(a, offsets), 1e-4 * double(fur_length));"}};
  for (const auto& [path, line] : planted)
    EXPECT_EQ(written_tolerances(path, line).size(), 1u) << path << ": " << line;
  const std::pair<const char*, const char*> allowed[] = {
      {"harness/compare/tolerances.hpp", "inline constexpr double picture_psnr = 60.0;"},
      {"harness/compare/checks.cpp", R"({"reference", "texels wet in one only", other, 0, false},)"},
      {"harness/compare/checks.cpp", R"({against, "fur pixels", double(agreement.pixels), 1, true},)"},
      {"harness/compare/checks.cpp", "{{against, \"worst\", found.worst, tolerance::stick_top, false}};"},
      {"harness/prepare/camera.cpp", "if (glm::length(right) < 1e-6 * glm::length(up))"},
      {"tests/support/fake.hpp", R"(row.check = {{"reference", "psnr", 71.5, 60, true}};)"},
      {"tests/shells/reference/render_test.cpp", "EXPECT_GT(agreement.psnr, 35);"}};
  for (const auto& [path, line] : allowed)
    EXPECT_TRUE(written_tolerances(path, line).empty()) << path << ": " << line;
}
