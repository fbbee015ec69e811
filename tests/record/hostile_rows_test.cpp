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

// A copy or a printout of a JSON value needs stack space for each level of nesting. A row with very deep
// nesting would therefore overflow the stack.
TEST(HostileRows, DeepNestingIsRefused) {
  const auto nested = [](std::size_t depth) {
    return line_of(changed_text([](Json& row) { row.erase("provenance"); }) +
                   ",\"provenance\":{\"cpus\":" + std::string(depth, '[') + std::string(depth, ']') + "}");
  };
  EXPECT_EQ(refusal_of_line(nested(10)), "accepted");
  EXPECT_EQ(refusal_of_line(nested(100)), "the row contains values that are nested more than 32 deep");
  EXPECT_EQ(refusal_of_line(nested(1'000'000)), "the row contains values that are nested more than 32 deep");
}

TEST(HostileRows, NumbersOutOfRangeAreRefused) {
  for (const char* field : {"repeat", "schema"})
    for (const Json& value : {Json(-1), Json(1e300), Json(0.5), Json(std::int64_t(1) << 40), Json("1")})
      test::expect_has(refusal_of_line(changed([&](Json& row) { row[field] = value; })),
                       "in place of a whole number");
  test::expect_has(refusal_of_line(changed([&](Json& row) {
                     row["tuning"] = {{"TILE_W", 1e300}};
                   })),
                   "whole number");
  test::expect_has(refusal_of_line(changed([](Json& row) { row["samples"]["frame"]["wall_ms"][1] = -1; })),
                   "one of the wall times of the phase frame is -1 ms");
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
