#include "harness/claims/claim.hpp"
#include "tests/claims/rows.hpp"
#include "tests/support/texts.hpp"

namespace pelage::claims {
namespace {

using namespace test;

/// Reads a file claims.toml that contains `text`. Returns the end of the error message, from the file's name
/// on. Returns "" if the reader accepts the file.
std::string message(const std::string& text) {
  const std::string what = pelage::test::refusal([&] { file_of(text); }, "");
  EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  return what.empty() ? what : what.substr(what.find("claims.toml"));
}

TEST(ClaimFiles, HoldEveryKey) {
  const ClaimFile file = file_of(R"(
process_spread = 0.1
separate_processes = 5
[[claim]]
id = "third"
statement = "Four times the layers take three times the time."
test = "15% more or less"
reading = "paper"
source = { paper = "key", section = "5" }
kind = "absolute"
hardware = "GeForce"
process_spread = 0.02
[claim.rows]
experiment = ["a", "b"]
where = { model = ["x", "y"], layers = 64, dynamics.solver = "rk4" }
overridden = true
cases = 4
[claim.effect]
name = "ratio"
quantity = "frame-rate"
axis = "layers"
phases = { frame = 64, quarter = 16 }
of = 64
to = 16
combine = "geometric-mean"
[claim.relation]
about = 0.25
tolerance = 0.2
[[claim]]
id = "strands"
statement = "Strands are fast."
reading = "as in files of earlier versions"
untestable = "there are none"
)");
  EXPECT_DOUBLE_EQ(file.process_spread, 0.1);
  EXPECT_EQ(file.separate_processes, 5);
  ASSERT_EQ(file.claims.size(), 2u);
  const Claim& c = file.claims[0];
  EXPECT_EQ(c.id, "third");
  EXPECT_EQ(c.paper, "key");
  EXPECT_EQ(c.section, "5");
  EXPECT_EQ(c.test, "15% more or less");
  EXPECT_EQ(c.reading, "paper");
  EXPECT_FALSE(c.ours());
  EXPECT_TRUE(file.claims[1].ours());
  EXPECT_EQ(file.claims[1].test, "as in files of earlier versions");
  EXPECT_EQ(file.claims[1].reading, "");
  EXPECT_TRUE(c.absolute);
  EXPECT_EQ(c.hardware, "GeForce");
  EXPECT_DOUBLE_EQ(c.process_spread, 0.02);
  EXPECT_EQ(c.experiments, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(c.where.at("model"), (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(c.where.at("layers"), (std::vector<std::string>{"64"}));
  EXPECT_EQ(c.where.at("dynamics.solver"), (std::vector<std::string>{"rk4"}));
  EXPECT_TRUE(c.overridden);
  EXPECT_EQ(c.cases, 4u);
  EXPECT_EQ(c.effect, Effect::ratio);
  EXPECT_EQ(c.quantity, Quantity::frame_rate);
  EXPECT_EQ(c.phases.at("quarter"), "16");
  EXPECT_EQ(c.of, (Selection{{"layers", "64"}}));
  EXPECT_EQ(c.combine, Combine::geometric_mean);
  EXPECT_DOUBLE_EQ(c.region.low.value(), 0.2);
  EXPECT_DOUBLE_EQ(c.region.high.value(), 0.3);
  EXPECT_EQ(c.relation, "0.25 +-20%");
  EXPECT_EQ(
      description_of(c),
      "frame rate with layers = 64, divided by the value with layers = 16; geometric mean over the cases; "
      "one process drew the cases alternately");
  EXPECT_EQ(file.claims[1].untestable, "there are none");
  EXPECT_DOUBLE_EQ(file_of(claim_text("", "{ above = 1 }")).claims[0].process_spread, 0.07);
}

TEST(ClaimFiles, NameTwoCasesByTheirAxes) {
  const Claim claim =
      file_of(claim_text("name = \"ratio\", of = { dynamics.solver = \"backward-euler\", step = "
                         "\"0.0166\" }, to = { dynamics.solver = \"explicit-euler\", step = \"0.002\" }",
                         "{ at_most = 1 }"))
          .claims[0];
  EXPECT_EQ(claim.of, (Selection{{"dynamics.solver", "backward-euler"}, {"step", "0.0166"}}));
  EXPECT_EQ(claim.to, (Selection{{"dynamics.solver", "explicit-euler"}, {"step", "0.002"}}));
  EXPECT_EQ(description_of(claim),
            "frame time with dynamics.solver = backward-euler, step = 0.0166, divided by the value with "
            "dynamics.solver = explicit-euler, step = 0.002; each case");
}

TEST(ClaimFiles, ReadEveryRelation) {
  const auto region = [](const std::string& relation) {
    return file_of(claim_text("name = \"elasticity\", axis = \"layers\"", relation)).claims[0].region;
  };
  EXPECT_TRUE(region("{ at_most = 2 }").contains(2));
  EXPECT_FALSE(region("{ below = 2 }").contains(2));
  EXPECT_TRUE(region("{ below = 2 }").contains(1.9));
  EXPECT_TRUE(region("{ at_least = 2 }").contains(2));
  EXPECT_FALSE(region("{ at_least = 2 }").contains(1.9));
  EXPECT_FALSE(region("{ above = 2 }").contains(2));
  EXPECT_TRUE(region("{ between = [1, 2] }").contains(1.5));
  EXPECT_FALSE(region("{ between = [1, 2] }").contains(2.5));
  EXPECT_FALSE(region("{ about = -1, tolerance = 0.1 }").contains(-0.8));
  EXPECT_TRUE(region("{ about = -1, tolerance = 0.1 }").contains(-1.05));
  EXPECT_TRUE(region("{ about = 1, tolerance = 0 }").contains(1));
  EXPECT_TRUE(region("\"decreasing\"").contains(-0.1));
  EXPECT_FALSE(region("\"decreasing\"").contains(0));
  EXPECT_TRUE(region("\"increasing\"").contains(0.1));
}

TEST(ClaimFiles, IncludeOtherFiles) {
  const pelage::test::Folder folder;
  const auto write = [&](const char* name, const std::string& text) {
    pelage::test::write_text(folder.path / name, text);
  };
  const std::string one = "[[claim]]\nid = \"one\"\nstatement = \"s\"\nuntestable = \"r\"\n";
  write("main.toml", "process_spread = 0.2\ninclude = [\"more.toml\"]\n" + one);
  write("more.toml", R"([[claim]]
id = "two"
statement = "s"
rows = { experiment = "e" }
effect = { name = "level" }
relation = { at_most = 1 }
)");
  const ClaimFile file = read_claims(folder.path / "main.toml");
  ASSERT_EQ(file.claims.size(), 2u);
  EXPECT_EQ(file.claims[1].id, "two");
  EXPECT_EQ(file.claims[1].process_spread, 0.2);
  const auto error = [&](const std::string& more) -> std::string {
    write("more.toml", more);
    const std::string what = pelage::test::refusal([&] { read_claims(folder.path / "main.toml"); });
    return what.substr(what.rfind('/') + 1);
  };
  EXPECT_EQ(error(one), "more.toml:1: two claims have the id one");
  EXPECT_EQ(error("include = []\n" + one),
            "more.toml:1: the key include is unknown or has no meaning here (known here: claim)");
  write("main.toml", "include = \"more.toml\"\n" + one);
  EXPECT_EQ(error(""), "main.toml:1: include must be a list of files, such as [\"more.toml\"]");
}

TEST(ClaimFiles, RefuseWrongKeysAndSayWhatIsRight) {
  const std::string level = "name = \"level\"", limit = "{ at_most = 1 }";
  EXPECT_EQ(message(claim_text(level, limit)), "");
  for (
      const auto& [text, wanted] : std::vector<std::pair<std::string, std::string>>{
          {"x = 1\n",
           ":1: the key x is unknown or has no meaning here (known here: claim, include, process_spread, "
           "separate_processes)"},
          {"", ": there is no [[claim]]; docs/experiments.md describes the format"},
          {"[[claim]]\nid = 3\n", ":2: claim: id must be a string"},
          {"[[claim]]\nstatement = \"s\"\n", ":1: claim: id = \"...\" is missing"},
          {"[[claim]]\nid = \"a\"\n", ":1: claim a: statement = \"...\" is missing"},
          {"[[claim]]\nid = \"a\"\nstatement = \"s\"\n",
           ":1: claim a: rows = { experiment = \"NAME\" } or untestable = \"REASON\" is missing"},
          {claim_text(level, "{ about = 1, tolerance = 1 }"),
           ":6: claim c: relation: tolerance must be a fraction of the number `about`, from 0 to less "
           "than 1"},
          {claim_text("name = \"slope\"", limit),
           ":5: claim c: effect: name = \"slope\" is unknown (known: level, ratio, ratio-by-phase, "
           "elasticity, linearity, ratio-trend, share-of-cases)"},
          {claim_text("name = \"ratio\", of = 64, to = 16", limit),
           ":5: claim c: effect: of = ... must be a table { AXIS = VALUE, ... }; for a single value, name its axis: "
           "axis = \"AXIS\""},
          {claim_text("name = \"ratio\", axis = \"layers\", of = { layers = 64 }, to = 16", limit),
           ":5: claim c: effect: of = ... must be a value of the axis layers"},
          {claim_text("name = \"ratio\", of = { layers = [64, 32] }, to = { layers = 16 }", limit),
           ":5: claim c: effect: of: give one value of the axis layers"},
          {claim_text("name = \"ratio\", axis = \"layers\", of = 64", limit),
           ":5: claim c: effect: to = ... must be a value of the axis layers"},
          {claim_text(level + ", axis = \"layers\"", limit),
           ":5: claim c: effect: the key axis is unknown or has no meaning here (known here: combine, name, "
           "per, quantity)"},
          {claim_text(level, "{ }"),
           ":6: claim c: relation: the relation has no limit; give at_most, at_least, below, above, between "
           "or about"},
          {claim_text(level, "{ at_most = 1, at_least = 0 }"),
           ":6: claim c: relation: a claim has only one relation"},
          {claim_text(level, "{ at_most = nan }"), ":6: claim c: relation: at_most must be a finite number"},
          {claim_text(level, "{ between = [2, 1] }"),
           ":6: claim c: relation: between needs two numbers, the smaller one first: between = [0.8, 1.25]"},
          {claim_text(level, "{ about = 1 }"),
           ":6: claim c: relation: the relation about needs the number tolerance"},
          {claim_text(level, "\"decreasing\""),
           ":6: claim c: \"decreasing\" needs the effect elasticity or ratio-trend"},
          {claim_text(level, "\"smaller\""),
           ":6: claim c: relation = \"smaller\" is unknown; give \"decreasing\", \"increasing\" or a table "
           "such as { at_most = 0.5 }"},
          {claim_text(level, limit, "experiment = \"own\", where = { step = 0.5 }"),
           ":4: claim c: rows: a value in where is neither a string nor a whole number; write decimal "
           "numbers as strings, with the digits of the experiment file"},
          {claim_text(level, limit, "experiment = \"own\", cases = 0"),
           ":4: claim c: rows: cases = 0 is not between 1 and 1e+06"},
          {claim_text(level, limit) + "process_spread = 1.5\n",
           ":7: claim c: process_spread = 1.5 is not between 0 and 1"},
          {"process_spread = 1.5\n" + claim_text(level, limit),
           ":1: process_spread = 1.5 is not between 0 and 1"},
          {claim_text(level, limit) + claim_text(level, limit), ":7: two claims have the id c"}})
    EXPECT_EQ(message(text), "claims.toml" + wanted);
  EXPECT_EQ(message("[[claim]\n").substr(0, 23), "claims.toml:1: not TOML");
  for (const int wrong : {0, 1001})
    EXPECT_NE(message(fmt::format("separate_processes = {}\n", wrong) + claim_text(level, limit)), "");
  for (const int right : {1, 1000})
    EXPECT_EQ(message(fmt::format("separate_processes = {}\n", right) + claim_text(level, limit)), "");
}

TEST(ClaimFiles, MustExist) {
  EXPECT_THROW(read_claims("/nowhere/claims.toml"), InputError);
  EXPECT_THROW(read_claims(PELAGE_SOURCE_DIR), InputError);
}

// Every shipped claim of a paper must name its source, and every claim must refer only to experiments that
// exist.
TEST(ClaimFiles, TheShippedFileIsComplete) {
  const ClaimFile file = read_claims(fs::path(PELAGE_SOURCE_DIR) / "experiments/claims.toml");
  EXPECT_GE(file.claims.size(), 18u);
  for (const Claim& claim : file.claims) {
    EXPECT_EQ(claim.paper.empty(), claim.section.empty()) << claim.id;
    EXPECT_TRUE(claim.untestable.empty() != claim.experiments.empty()) << claim.id;
    for (const std::string& name : claim.experiments) {
      EXPECT_TRUE(fs::exists(fs::path(PELAGE_SOURCE_DIR) / "experiments" / (name + ".toml")))
          << claim.id << ' ' << name;
    }
    if (claim.absolute && claim.untestable.empty()) {
      EXPECT_TRUE(claim.quantity == Quantity::frame_rate || claim.quantity == Quantity::phase_time ||
                  claim.metric.ends_with("_ms"))
          << claim.id;
    }
  }
}

}  // namespace
}  // namespace pelage::claims
