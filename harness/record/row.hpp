// One row of results: one case on one device, as one line of JSON. docs/results.md describes every field.
#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/error.hpp"
#include "harness/record/check.hpp"
#include "harness/record/identity.hpp"

namespace pelage {

/// The schema of new rows. Rows of schema 1 have no identity. In rows of schemas 1 and 2, some metrics have
/// other names (harness/record/ratios.hpp).
inline constexpr int kRowSchema = 3;

enum class Status { ok, failed_check, diverged, unsupported, skipped, error };

std::string_view to_text(Status status);  ///< "ok", "failed-check", ...

/// Measured times of one phase in milliseconds, in the order of measurement. `wall_ms` is empty for a phase
/// within a frame, which has no separate wall time. `event_ms` is empty if the device has no usable timer.
/// `cpu_ms` is the CPU time that all threads of this process used during `wall_ms`; it is empty in rows of
/// earlier versions.
struct PhaseSamples {
  std::vector<double> event_ms, wall_ms, cpu_ms = {};
};

/// A measured number, or a number printed in a paper. A printed number has a relation ("=", "<", "about" or
/// "range") and represents an interval; for instance, 267 fps represents 266.5 to 267.5 fps. `low` or `high`
/// is empty if the paper does not give this limit.
struct Metric {
  double value = 0;
  std::string unit;
  std::string relation = {};
  std::optional<double> low = {}, high = {};
};

struct Row {
  int schema = kRowSchema;  ///< 1 or kRowSchema: row_from_line() converts rows of schema 2
  std::string run_id;
  std::string experiment;
  std::string case_name;
  std::string variant;  ///< name of the timed variant, such as "shells/tile"
  /// Axis -> value in this case. to_line() writes numbers as JSON numbers.
  std::map<std::string, std::string> axes;
  std::map<std::string, std::string>
      overrides;  ///< values of --set, --axis and --model; empty if the experiment was not changed
  std::string device;
  Identity identity;  ///< empty in rows of schema 1; may be incomplete if the status is error
  int repeat = 0;     ///< index of the process among the processes that --repeat starts, from 0
  Status status = Status::ok;
  std::string reason;  ///< reason for a status other than ok, or a note about an ok row
  std::vector<Check> check;
  std::map<std::string, PhaseSamples> samples;  ///< phase -> times; the phase "frame" is the whole frame
  std::map<std::string, Metric> metrics;
  double build_ms = 0;
  double first_launch_ms = 0;
  std::map<std::string, int> tuning;
  std::string image_hash;
  nlohmann::ordered_json provenance = nlohmann::ordered_json::object();
};

/// Returns the text that identifies the row in its journal.
std::string row_key(const Row& row);

/// Returns the row as one line without a line feed, which ends with the field "crc", the CRC-32 of the text
/// before it.
std::string to_line(const Row& row);

/// Thrown for a row with a schema that only a newer version of pelage reads.
struct NewerSchema : InputError {
  using InputError::InputError;
};

/// Reads a line that to_line() wrote, and converts rows of older schemas (convert_to_present()). Throws
/// InputError for a wrong checksum, invalid JSON, a missing field, a wrong type, fields that contradict each
/// other (harness/record/contradiction.hpp), or a schema that this version of pelage does not read.
Row row_from_line(std::string_view line);

/// Returns the value of the axis or of another key; "" if `values` lacks it.
std::string value_at(const std::map<std::string, std::string>& values, const std::string& key);

/// Returns the text or number that the provenance of the row stores under `key`; "" or no value without it.
std::string provenance_text(const Row& row, const char* key);
std::optional<double> provenance_number(const Row& row, const char* key);

/// Returns the wall times of whole frames in ms; an empty list if the row is not ok.
std::vector<double> frame_ms(const Row& row);

/// Returns the times of a phase that count in claims, reports and comparisons: its wall times, or its event
/// times if it has no wall times, as a phase within a frame. Returns an empty list if the row has none.
const std::vector<double>& times_of(const Row& row, const std::string& phase);

}  // namespace pelage
