// Runs cases one after the other and journals a row of each.
#pragma once
#include <filesystem>
#include <functional>
#include <limits>

#include "harness/journal/journal.hpp"
#include "harness/measure/subject.hpp"

namespace pelage {

struct RunPlan {
  std::string run_id, experiment, device;
  int repeat = 0;
  std::vector<Case> cases;  ///< in the order in which they run
  SamplingLimits limits;
  double budget_s =
      std::numeric_limits<double>::infinity();  ///< no case starts after it; samples share what is left
  std::filesystem::path images;                 ///< folder of the pictures; empty: none are written
  std::string image_suffix;                     ///< after the case's name, to keep devices apart
  nlohmann::ordered_json provenance;            ///< of the whole run; the case's own is added
};

/// Told what goes on; each may be empty.
struct RunListener {
  std::function<void(std::size_t index, const Case&)> starting;
  std::function<void(std::size_t index, const Row&)> finished;
};

struct RunSummary {
  std::size_t ok = 0, kept = 0, not_ok = 0,
              left = 0;    ///< kept: found in a resumed journal; left: the budget was spent
  bool bad_input = false;  ///< some row failed on its input rather than on the device
};

/// The key under which this case's row will stand.
std::string planned_key(const RunPlan& plan, const Case& which);

/// One case: prepare, sample, read the timed frame back, check it. Never throws for what is wrong with the
/// case or the device: the row says it. Samples are kept only in rows that are ok.
Row run_case(const RunPlan& plan, const Case& which, const SamplingLimits& limits, const MakeSubject& make);

/// All cases that the journal does not hold yet. Throws InputError when the journal cannot be written.
RunSummary run_cases(const RunPlan& plan, const MakeSubject& make, Journal& journal,
                     const RunListener& listener = {});

}  // namespace pelage
