// Runs the cases of an experiment one after the other and appends one row per case to the journal.
#pragma once
#include <filesystem>
#include <functional>
#include <limits>

#include "harness/measure/subject.hpp"
#include "harness/record/journal.hpp"

namespace pelage {

struct RunPlan {
  std::string run_id, experiment, device;
  int repeat = 0;
  std::vector<Case> cases;  ///< cases in the order in which they run
  SamplingLimits limits;
  /// Returns the identity of a case without the parts that the subject's describe() adds. May be empty, may
  /// throw InputError.
  std::function<Identity(const Case&)> identity;
  /// Returns the entry `settings` of the provenance of a case: the scene keys that differ from their
  /// defaults. May be empty, may throw InputError.
  std::function<nlohmann::ordered_json(const Case&)> settings;
  /// Returns the entry `gpu` of the provenance, right after a case was timed (gpu_state()). May be empty.
  std::function<nlohmann::ordered_json()> gpu;
  /// Time limit of the run in seconds, after which no case starts. The timed frames of a case take at most
  /// the remaining time of the run divided by the number of remaining cases, including this case.
  double budget_s = std::numeric_limits<double>::infinity();
  std::filesystem::path images;       ///< folder for the pictures; if empty, no pictures are written
  std::string image_suffix;           ///< added to a picture's file name, to distinguish devices
  nlohmann::ordered_json provenance;  ///< entries for the provenance of every row; a case may add entries
};

/// Functions that are called during a run. Each may be empty.
struct RunListener {
  /// Called before each case. If it returns false, neither this case nor any later case starts.
  std::function<bool(const Case&)> may_start;
  std::function<void(std::size_t index, const Case&)> starting;
  std::function<void(std::size_t index, const Row&)> finished;
};

/// Numbers of cases: `ok` with the status ok or unsupported, `kept` that already had a row in the journal,
/// `not_ok` with another status, and `left` that did not start because of the time limit or may_start.
/// `disturbed` is true if RunListener::may_start returned false.
struct RunSummary {
  std::size_t ok = 0, kept = 0, not_ok = 0, left = 0;
  bool disturbed = false;
};

std::string planned_key(const RunPlan& plan, const Case& which);

/// Runs one case: prepares it, takes samples, reads the timed frame back and checks it. Errors of the case or
/// of the device set the status and the reason of the row. Only rows with the status `ok` contain samples.
Row run_case(const RunPlan& plan, const Case& which, const SamplingLimits& limits, const MakeSubject& make);

/// Runs all cases that are not yet in the journal. Throws InputError if the journal cannot be written.
RunSummary run_cases(const RunPlan& plan, const MakeSubject& make, Journal& journal,
                     const RunListener& listener = {});

}  // namespace pelage
