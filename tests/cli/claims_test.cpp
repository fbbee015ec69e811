// Tests the command `pelage claims` with the results that are recorded in the repository, and with invalid
// input.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/document.hpp"

namespace pelage::cli {
namespace {

const std::string results = "'" PELAGE_SOURCE_DIR "/results'";

struct Claims : InFolder {};

TEST_F(Claims, OfThePapersAreJudgedByTheRecordings) {
  const Outcome text = done("claims " + results + " --all --csv claims.csv");
  EXPECT_EQ(text.err, "");
  const Outcome json = pelage("claims " + results + " --json");
  const auto list = nlohmann::json::parse(json.out);
  std::size_t decided = 0;
  for (const auto& claim : list) {
    decided += claim["verdict"] != "untestable";
    expect_has(text.out, claim["id"].get<std::string>());
    const bool reason = !claim["reason"].get<std::string>().empty();
    if (claim["verdict"] != "fails") {
      EXPECT_NE(claim["verdict"] == "holds", reason);
    } else if (claim["kind"] == "absolute" || claim["id"] == "no-flip") {
      EXPECT_TRUE(reason) << claim["id"];
    }
  }
  EXPECT_GE(list.size(), 18u);
  EXPECT_GE(decided, 18u);
  const std::string csv = folder.read("claims.csv");
  EXPECT_EQ(std::size_t(std::count(csv.begin(), csv.end(), '\n')), list.size() + 1);
  EXPECT_EQ(pelage("claims " + results + " --csv -").out, csv);
}

TEST_F(Claims, TheTableOfTheDocumentIsThatOfTheRecordings) {
  const std::string document = test::text_of(PELAGE_SOURCE_DIR "/results/claims.md");
  const std::size_t table = document.find("| claim ");
  ASSERT_NE(table, std::string::npos);
  EXPECT_EQ(document.substr(table), pelage("claims " + results + " --markdown").out)
      << "the last lines of scripts/record_all.sh write the table";
}

// Tests that the example in docs/experiments.md is a complete file of claims.
TEST_F(Claims, OfTheUserNeedNoProgram) {
  for (const Block& block : blocks_of(PELAGE_SOURCE_DIR "/docs/experiments.md"))
    if (has(block.text, "[[claim]]")) folder.write("my.toml", block.text);
  const Outcome none = done("claims " + results + " --claims my.toml");
  EXPECT_EQ(
      none.out,
      "1 claim needs rows of these experiments, which have no rows here: my-experiment; --all lists it\n"
      "Claims of our own, 1: 0 holds, 0 fails, 0 undecided, 1 untestable\n");
  expect_has(pelage("claims " + results + " --claims my.toml --all").out,
             "untestable: there are no rows of the experiment my-experiment");
}

TEST_F(Claims, WithoutRowsAreOneLine) {
  const std::string one = "claims " + results.substr(0, results.size() - 1) + "/layers'";
  const Outcome text = pelage(one), all = pelage(one + " --all");
  expect_lacks(text.out, "there are no rows of the experiment");
  expect_has(all.out, "there are no rows of the experiment");
  expect_has(text.out, " claims need rows of these experiments, which have no rows here: ");
  const auto counts = [](const std::string& out) { return out.substr(out.rfind('\n', out.size() - 2)); };
  EXPECT_EQ(counts(text.out), counts(all.out));
}

TEST_F(Claims, WrongInputGivesOneLineAndCode2) {
  folder.write("wrong.toml", "[[claim]]\nid = \"a\"\nstatement = \"b\"\nrows = 3\n");
  const std::pair<const char*, const char*> refused[] = {
      {"--claims wrong.toml", "wrong.toml:4: claim a: rows must be a table: { key = value }"},
      {"--claims missing.toml", "missing.toml"},
      {"--csv /nowhere/x.csv", "/nowhere/x.csv"},
      {"--json --markdown", "--json"}};
  for (const auto& [options, message] : refused) {
    const Outcome outcome = pelage("claims " + results + " " + options);
    expect_refused(outcome, message);
    EXPECT_EQ(outcome.out, "") << outcome.arguments;
  }
  EXPECT_EQ(pelage("claims").code, 2);
}

}  // namespace
}  // namespace pelage::cli
