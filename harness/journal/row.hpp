// One row of results: one case on one device, as one line of JSON. docs/results.md describes every field.
#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/compare/check.hpp"

namespace pelage {

inline constexpr int kRowSchema = 1;

enum class Status { ok, failed_check, diverged, unsupported, skipped, error };

std::string_view to_text(Status status);                        ///< "ok", "failed-check", ...
std::optional<Status> status_from_text(std::string_view text);  ///< empty: no such status

/// Raw times of one phase, ms, in the order taken. Any list may be empty: a phase within a frame has no wall
/// time of its own, an event time is missing where the device's timer is not real, and rows of earlier
/// versions have no CPU time. `cpu_ms` is what all threads of this process used during `wall_ms`.
struct PhaseSamples {
  std::vector<double> event_ms, wall_ms, cpu_ms = {};
};

/// A measured or published number. A published one carries its relation: "=", "<", "about" or "range", and
/// the interval it stands for (whole fps: +-0.5; no upper or lower end: censored).
struct Metric {
  double value = 0;
  std::string unit;
  std::string relation = {};
  std::optional<double> low = {}, high = {};
};

struct Row {
  std::string run_id;
  std::string experiment;
  std::string case_name;
  std::string variant;                           ///< pipeline, mapping, solver, tuning
  std::map<std::string, std::string> axes;       ///< numbers are written as JSON numbers
  std::map<std::string, std::string> overrides;  ///< --set, --axis, --model; empty: the experiment as shipped
  std::string device;
  int repeat = 0;  ///< the process of --repeat that took the samples, from 0
  Status status = Status::ok;
  std::string reason;  ///< why not ok, or a caveat
  std::vector<Check> check;
  std::map<std::string, PhaseSamples> samples;  ///< simulate, wet, transform, bin, raster, resolve, frame
  std::map<std::string, Metric> metrics;
  double build_ms = 0;
  double first_launch_ms = 0;
  std::map<std::string, int> tuning;
  std::string image_hash;
  nlohmann::ordered_json provenance = nlohmann::ordered_json::object();
};

/// What makes a row one of a kind in its journal.
std::string row_key(const Row& row);

/// The row as one line without its line feed; the last field is the checksum of all that stands before it.
std::string to_line(const Row& row);

/// Reads such a line back. Throws InputError with what is wrong: checksum, JSON, a missing or ill-typed
/// field, a newer schema.
Row row_from_line(std::string_view line);

/// The headline samples: wall times of whole frames, ms; empty unless the row is ok.
std::vector<double> frame_ms(const Row& row);

}  // namespace pelage
