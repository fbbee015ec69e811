#include "harness/record/journal.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>

#include "harness/experiment/balance.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/record/shards.hpp"
#include "harness/report/cells.hpp"
#include "tests/fuzz/support.hpp"
#include "tests/fuzz/targets.hpp"

namespace pelage::fuzz {
namespace {

/// If the line is enclosed in braces, adds the checksum of a row. pelage rejects lines without a valid
/// checksum before it parses them, so the fuzzer could not test the parser without this function.
std::string with_checksum(std::string_view line) {
  if (line.size() < 2 || line.front() != '{' || line.back() != '}') return std::string(line);
  const std::string_view body = line.substr(0, line.size() - 1);
  const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(body.data()), body.size());
  return fmt::format("{},\"crc\":\"{:08x}\"}}", body, sum);
}

std::string with_checksums(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    result += with_checksum(text.substr(0, end)) + (end < text.size() ? "\n" : "");
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result;
}

}  // namespace

// Tests the parser of journals. If the parser accepts a row, pelage must be able to write the row and to read
// it again. The commands that use rows must not crash.
void journal(std::string_view bytes) {
  const MemoryFile file(with_checksums(bytes));
  may_refuse([&] {
    std::vector<FoundRow> rows;
    for (Row& row : read_contents(file.path()).rows) {
      const std::string line = to_line(row);
      expect(to_line(row_from_line(line)) == line, "the written row is another row");
      load_warning(row);
      case_seconds(row);
      rows.push_back({std::move(row), "a@b.0-of-2.jsonl", {}});
    }
    for (const RunState& state : run_states({"a@b.0-of-2.jsonl"}, rows))
      for (const Gap& gap : state.gaps) text_of(gap);
    cells_of(rows);
  });
}

}  // namespace pelage::fuzz
