// Tests that docs/results.md lists exactly the tests of this folder.
#include <algorithm>
#include <regex>
#include <vector>

#include "tests/support/files.hpp"

namespace pelage::planted {
namespace {

std::vector<std::string> tests_of(const std::string& suite) {
  std::vector<std::string> names;
  const ::testing::UnitTest& all = *::testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const ::testing::TestSuite& one = *all.GetTestSuite(s);
    if (one.name() != suite) continue;
    for (int t = 0; t < one.total_test_count(); ++t) names.emplace_back(one.GetTestInfo(t)->name());
  }
  return names;
}

/// Returns the names of the tests of `suite` that the document cites.
std::vector<std::string> listed(const std::string& text, const std::string& suite) {
  const std::regex name("`" + suite + "\\.(\\w+)`");
  std::vector<std::string> names;
  for (std::sregex_iterator match(text.begin(), text.end(), name), end; match != end; ++match)
    names.push_back((*match)[1]);
  return names;
}

TEST(List, TheDocumentNamesEveryTestOnce) {
  const std::string text = test::text_of(PELAGE_SOURCE_DIR "/docs/results.md");
  for (const auto& [suite, least] : {std::pair{"Planted", 24U}, {"Honest", 20U}}) {
    std::vector<std::string> in_document = listed(text, suite), in_program = tests_of(suite);
    EXPECT_GE(in_document.size(), least);
    std::sort(in_document.begin(), in_document.end());
    std::sort(in_program.begin(), in_program.end());
    EXPECT_EQ(in_document, in_program);
  }
}

}  // namespace
}  // namespace pelage::planted
