// Tests rows with a valid checksum whose contents no version of pelage would write.
#include <fmt/format.h>
#include <zlib.h>

#include <functional>

#include "harness/record/row.hpp"
#include "tests/support/fake.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the line of a row with this text, which lacks the last brace, and a correct checksum.
std::string line_of(const std::string& body) {
  const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(body.data()), body.size());
  return fmt::format("{},\"crc\":\"{:08x}\"}}", body, sum);
}

/// Applies `change` to a sample row, and returns the text of the changed row without the last brace.
std::string changed_text(const std::function<void(Json&)>& change) {
  Json json = Json::parse(to_line(test::sample_row("a")));
  json.erase("crc");
  change(json);
  std::string body = json.dump();
  body.pop_back();
  return body;
}

std::string changed(const std::function<void(Json&)>& change) {
  return line_of(changed_text(change));
}

std::string refusal_of_line(const std::string& line) {
  return test::refusal([&] { row_from_line(line); });
}

TEST(HostileRows, AnUnchangedRowIsAccepted) {
  EXPECT_EQ(refusal_of_line(changed([](Json&) {})), "accepted");
}

TEST(HostileRows, NumbersMayReachTheirLimits) {
  Row row = test::sample_row("a");
  row.samples = {{"frame", {{11}, {10}, {35}}}, {"raster", {{11}, {}}}};
  row.metrics = {{"covered_fragments", {0, "fragments"}}, {"fragments_per_s", {0, "1/s"}}};
  row.provenance["cpus"] = 1;
  EXPECT_EQ(refusal_of_line(to_line(row)), "accepted");
  row.samples["frame"].cpu_ms = {36};
  EXPECT_EQ(refusal_of_line(to_line(row)),
            "the median CPU time of the phase frame is 36 ms, which is more than 1 CPUs can use in 10 ms");
  row.provenance["cpus"] = 2;
  row.metrics = {{"covered_fragments", {1e9, "fragments"}}, {"fragments_per_s", {1.0000001e11, "1/s"}}};
  EXPECT_EQ(refusal_of_line(to_line(row)), "accepted");
  row.provenance = {{"check_seed", 5}};  // rows of schema 1 have other seeds
  row.schema = 1;
  EXPECT_EQ(refusal_of_line(to_line(row)), "accepted");
}

// A copy or a printout of a JSON value needs stack space for each level of nesting. A row with very deep
// nesting would therefore overflow the stack.
TEST(HostileRows, DeepNestingIsRefused) {
  const auto nested = [](std::size_t depth) {
    return line_of(changed_text([](Json& row) { row.erase("provenance"); }) +
                   ",\"provenance\":{\"cpus\":" + std::string(depth, '[') + std::string(depth, ']') + "}");
  };
  EXPECT_EQ(refusal_of_line(nested(31)), "accepted");
  EXPECT_EQ(refusal_of_line(nested(32)), "the row contains values that are nested more than 32 deep");
  EXPECT_EQ(refusal_of_line(nested(1'000'000)), "the row contains values that are nested more than 32 deep");
}

TEST(HostileRows, NumbersOutOfRangeAreRefused) {
  for (const char* field : {"repeat", "schema"})
    for (const Json& value :
         {Json(-1), Json(1e300), Json(0.5), Json(std::int64_t(1) << 40), Json(std::string(50, '1'))})
      EXPECT_EQ(refusal_of_line(changed([&](Json& row) { row[field] = value; })),
                fmt::format("the row contains {} in place of a whole number of 0 to 2147483647",
                            value.dump().substr(0, 40)));
  EXPECT_EQ(refusal_of_line(changed([](Json& row) { row["repeat"] = 2147483647; })), "accepted");
  test::expect_has(refusal_of_line(changed([&](Json& row) {
                     row["tuning"] = {{"TILE_W", 1e300}};
                   })),
                   "whole number");
  test::expect_has(refusal_of_line(changed([](Json& row) { row["samples"]["frame"]["event_ms"][1] = 0; })),
                   "one of the event times of the phase frame is 0 ms");
}

// Commands read the keys below without checking the types of their values, so the parser of rows must check
// these types.
TEST(HostileRows, ProvenanceOfWrongTypesIsRefused) {
  EXPECT_EQ(refusal_of_line(changed([](Json& row) { row["provenance"] = "x"; })),
            "the provenance of the row is not an object");
  for (const char* key : {"host", "preset", "shard_deal", "title", "utc"})
    EXPECT_EQ(refusal_of_line(changed([&](Json& row) { row["provenance"][key] = 1; })),
              fmt::format("provenance.{} of the row is not a text", key));
  EXPECT_EQ(refusal_of_line(changed([](Json& row) { row["provenance"]["converged"] = "yes"; })),
            "provenance.converged of the row is not true or false");
  EXPECT_EQ(refusal_of_line(changed([](Json& row) { row["provenance"]["other_cpu_share"] = "much"; })),
            "provenance.other_cpu_share of the row is not a number");
}

}  // namespace
}  // namespace pelage
