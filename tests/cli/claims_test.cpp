// Tests the command `pelage claims` with the results that are recorded in the repository, and with invalid
// input.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

const std::string results = "'" PELAGE_SOURCE_DIR "/results'";

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin), to = text.find(end);
  if (from == std::string::npos || to == std::string::npos) return "the document has no such lines";
  const std::size_t start = text.find('\n', from) + 1;
  return text.substr(start, to - start);
}

TEST(Claims, OfThePapersAreJudgedByTheRecordings) {
  const Folder folder;
  const Outcome text = pelage(folder, "claims " + results + " --all --csv claims.csv");
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_EQ(text.err, "");
  const Outcome json = pelage(folder, "claims " + results + " --json");
  const auto list = nlohmann::json::parse(json.out);
  std::size_t decided = 0;
  for (const auto& claim : list) {
    decided += claim["verdict"] != "untestable";
    EXPECT_NE(text.out.find(claim["id"].get<std::string>()), std::string::npos);
    EXPECT_NE(claim["verdict"] == "undecided" || claim["verdict"] == "untestable",
              claim["reason"].get<std::string>().empty());
  }
  EXPECT_GE(list.size(), 18u);
  EXPECT_GE(decided, 18u);
  const std::string csv = folder.read("claims.csv");
  EXPECT_EQ(std::size_t(std::count(csv.begin(), csv.end(), '\n')), list.size() + 1);
  EXPECT_EQ(pelage(folder, "claims " + results + " --csv -").out, csv);
}

TEST(Claims, TheTableOfTheDocumentIsThatOfTheRecordings) {
  const Folder folder;
  std::ifstream file(PELAGE_SOURCE_DIR "/results/claims.md", std::ios::binary);
  const std::string document{std::istreambuf_iterator<char>(file), {}};
  const std::size_t table = document.find("| claim ");
  ASSERT_NE(table, std::string::npos);
  EXPECT_EQ(document.substr(table), pelage(folder, "claims " + results + " --markdown").out)
      << "the last lines of scripts/record_all.sh write the table";
}

// Tests that the example in docs/experiments.md is a complete file of claims.
TEST(Claims, OfTheUserNeedNoProgram) {
  const Folder folder;
  std::ifstream file(PELAGE_SOURCE_DIR "/docs/experiments.md", std::ios::binary);
  const std::string document{std::istreambuf_iterator<char>(file), {}};
  folder.write("my.toml", between(document, "```toml", "```\n\n| key"));
  const Outcome none = pelage(folder, "claims " + results + " --claims my.toml");
  EXPECT_EQ(none.code, 0) << none.err;
  EXPECT_EQ(
      none.out,
      "1 claim needs rows of these experiments, which have no rows here: my-experiment; --all lists it\n"
      "1 claims: 0 holds, 0 fails, 0 undecided, 1 untestable\n");
  const Outcome all = pelage(folder, "claims " + results + " --claims my.toml --all");
  EXPECT_NE(all.out.find("untestable: there are no rows of the experiment my-experiment"), std::string::npos)
      << all.out;
}

// With the rows of one experiment, the claims about all other experiments are one line.
TEST(Claims, WithoutRowsAreOneLine) {
  const Folder folder;
  const std::string one = "claims " + results.substr(0, results.size() - 1) + "/layers'";
  const Outcome text = pelage(folder, one), all = pelage(folder, one + " --all");
  EXPECT_EQ(text.out.find("there are no rows of the experiment"), std::string::npos) << text.out;
  EXPECT_NE(all.out.find("there are no rows of the experiment"), std::string::npos);
  EXPECT_NE(text.out.find(" claims need rows of these experiments, which have no rows here: "),
            std::string::npos)
      << text.out;
  const auto counts = [](const std::string& out) { return out.substr(out.rfind('\n', out.size() - 2)); };
  EXPECT_EQ(counts(text.out), counts(all.out));
}

TEST(Claims, WrongInputGivesOneLineAndCode2) {
  const Folder folder;
  folder.write("wrong.toml", "[[claim]]\nid = \"a\"\nstatement = \"b\"\nrows = 3\n");
  for (const char* arguments :
       {"--claims wrong.toml", "--claims missing.toml", "--csv /nowhere/x.csv", "--json --markdown"}) {
    const Outcome outcome = pelage(folder, "claims " + results + " " + arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments;
  }
  EXPECT_EQ(pelage(folder, "claims " + results + " --claims wrong.toml").err,
            "pelage: wrong.toml:4: claim a: rows must be a table: { key = value }\n");
  EXPECT_EQ(pelage(folder, "claims").code, 2);
}

}  // namespace
}  // namespace pelage::cli
