#include <cstdlib>

#include "harness/error.hpp"
#include "harness/measure/runner.hpp"
#include "tests/support/fake.hpp"

namespace pelage {
namespace {

/// Prints the lines of the journals that python3-jsonschema rejects with docs/row.schema.json, and returns
/// their number.
int refused_lines(const std::vector<fs::path>& journals, const fs::path& folder) {
  const std::string script = R"(
import json, sys
import jsonschema
validator = jsonschema.Draft7Validator(json.load(open(sys.argv[1])))
jsonschema.Draft7Validator.check_schema(validator.schema)
refused = [(file, line) for file in sys.argv[2:] for line in open(file) if not validator.is_valid(json.loads(line))]
print(*refused, sep="\n")
sys.exit(min(255, len(refused)))
)";
  const fs::path program = folder / "validate.py";
  test::write_text(program, script);
  std::string command =
      "/usr/bin/python3 " + program.string() + " " PELAGE_SOURCE_DIR "/docs/row.schema.json";
  for (const fs::path& journal : journals) command += " '" + journal.string() + "'";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

struct Schema : test::InFolder {};

TEST_F(Schema, HoldsRowsOfEveryStatus) {
  const fs::path file = folder.path / "j.jsonl";
  {
    Journal journal(file, Journal::Mode::fresh);
    RunPlan plan = test::fake_plan(4);
    plan.cases[3].published = Metric{1, "fps", "<", std::nullopt, 1.0};
    plan.limits = {0, 6, 10, 0.5, 1};
    run_cases(
        plan,
        [](const Case& c) -> std::unique_ptr<Subject> {
          if (c.name == "case0") throw DeviceError("CL_OUT_OF_RESOURCES");
          if (c.name == "case1") throw Unsupported("no");
          if (c.name == "case2") return std::make_unique<test::FakeSubject>(10, 20);
          return std::make_unique<test::FakeSubject>(10);
        },
        journal);
    journal.append(test::sample_row("by hand"));
  }
  ASSERT_EQ(read_contents(file).rows.size(), 5u);
  EXPECT_EQ(refused_lines({file}, folder.path), 0);
}

// Rows of earlier revisions may have no CPU times, no picture, or times of other phases.
TEST_F(Schema, HoldsTheRowsOfResults) {
  const std::vector<fs::path> journals = test::files_below(PELAGE_SOURCE_DIR "/results", ".jsonl");
  EXPECT_FALSE(journals.empty());
  EXPECT_EQ(refused_lines(journals, folder.path), 0);
  for (const fs::path& journal : journals) EXPECT_FALSE(read_contents(journal).rows.empty()) << journal;
}

TEST_F(Schema, RefusesWhatNoRowMayBe) {
  const fs::path file = folder.path / "j.jsonl";
  auto with = [](auto change) {
    auto json = nlohmann::ordered_json::parse(to_line(test::sample_row("a")));
    change(json);
    return json.dump() + "\n";
  };
  std::string text;
  text += with([](auto& j) { j.erase("image_hash"); });
  text += with([](auto& j) { j["status"] = "fine"; });
  text += with([](auto& j) { j["status"] = "failed-check"; });  // a failed row must not have samples
  text += with([](auto& j) { j["check"] = nlohmann::ordered_json::array(); });
  text += with([](auto& j) { j["samples"].erase("frame"); });
  text += with([](auto& j) { j["speed"] = 1; });
  text += with([](auto& j) { j["schema"] = kRowSchema + 1; });
  text += with([](auto& j) { j["samples"]["frame"]["cpu_ms"] = "8"; });
  text += with([](auto& j) { j["image_hash"] = ""; });
  test::write_text(file, text);
  EXPECT_EQ(refused_lines({file}, folder.path), 9);
}

}  // namespace
}  // namespace pelage
