#include "harness/measure/runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "harness/compare/checks.hpp"
#include "harness/file_hash.hpp"
#include "harness/hash.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/measure/interrupt.hpp"
#include "harness/measure/interruptions.hpp"
#include "harness/measure/provenance.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/record/contradiction.hpp"

namespace pelage {
namespace {

bool finite(const Picture& picture) {
  return std::all_of(picture.pixel.begin(), picture.pixel.end(), [](const glm::vec4& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.w);
  });
}

std::string picture_hash(const Picture& picture) {
  return Hash()
      .number(std::uint64_t(picture.width))
      .number(std::uint64_t(picture.height))
      .values(picture.pixel)
      .hex();
}

/// Sets the status and the reason of a row: `diverged` if the picture has values that are not finite,
/// `failed_check` if the row has no check or a check does not hold.
void judge(Row& row, const Picture& picture) {
  if (!finite(picture)) {
    row.status = Status::diverged;
    row.reason = "the picture contains values that are not finite";
    return;
  }
  if (row.check.empty()) {
    row.status = Status::failed_check;
    row.reason = "nothing was checked";
    return;
  }
  for (const Check& check : row.check) {
    if (check.holds()) continue;
    row.status = Status::failed_check;
    row.reason += fmt::format("{}{} against {} is {:.6g}, but must be {} {:.6g}",
                              row.reason.empty() ? "" : "; ", check.metric, check.against, check.value,
                              check.at_least ? "at least" : "at most", check.limit);
    if (check.metric == windows_metric) row.reason += ": " + window_advice();
  }
}

Row blank_row(const RunPlan& plan, const Case& which) {
  Row row;
  row.run_id = plan.run_id;
  row.experiment = plan.experiment;
  row.case_name = which.name;
  row.variant = which.variant;
  row.axes = which.axes;
  row.overrides = which.overrides;
  row.device = plan.device;
  row.repeat = plan.repeat;
  row.provenance = plan.provenance;
  row.provenance["pipeline"] = which.pipeline;
  row.provenance["utc"] = utc_now();
  row.provenance["started_s"] = unix_time();
  row.provenance["load"] = load_average();
  return row;
}

double seconds_since(std::chrono::steady_clock::time_point from) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
}

}  // namespace

std::string planned_key(const RunPlan& plan, const Case& which) {
  return row_key(blank_row(plan, which));
}

Row run_case(const RunPlan& plan, const Case& which, const SamplingLimits& limits, const MakeSubject& make) {
  Row row = blank_row(plan, which);
  auto fails = [&row](Status status, const std::string& reason) {
    row.status = status;
    row.reason = reason;
  };
  try {
    if (plan.settings) row.provenance["settings"] = plan.settings(which);
    if (plan.identity) row.identity = plan.identity(which);
    const auto from = std::chrono::steady_clock::now();
    const std::unique_ptr<Subject> subject = make(which);
    row.provenance["prepare_s"] = seconds_since(from);
    row.provenance["cpu_mhz"] = cpu_mhz();
    const auto sampling_from = std::chrono::steady_clock::now();
    const CpuWatch watch;
    const Interruptions before = interruptions();
    const Sampling sampling = take_samples([&subject] { return subject->frame(); }, limits);
    if (plan.gpu)
      if (auto state = plan.gpu(); !state.empty()) row.provenance["gpu"] = std::move(state);
    if (const std::optional<double> share = watch.other_share()) row.provenance["other_cpu_share"] = *share;
    add_interruptions(row, before, interruptions());
    row.provenance["sampling_s"] = seconds_since(sampling_from);
    row.provenance["load_after"] = load_average();
    row.provenance["cpu_mhz_after"] = cpu_mhz();
    row.provenance["precision"] = limits.precision;
    row.first_launch_ms = sampling.first_launch_ms;
    const Picture picture = subject->read();
    if (!picture.pixel.empty()) row.image_hash = picture_hash(picture);
    if (!plan.images.empty() && !picture.pixel.empty()) {
      std::filesystem::create_directories(plan.images);
      const std::filesystem::path file = plan.images / (which.name + plan.image_suffix + ".png");
      write_picture(file, picture);
      row.provenance["picture_hash"] = hash_of_file(file);
    }
    const auto check_from = std::chrono::steady_clock::now();
    row.check = subject->check(picture);
    row.provenance["check_s"] = seconds_since(check_from);
    row.samples = sampling.samples;
    remove_implausible_events(row);
    subject->describe(row);
    for (const auto& [metric, least] : which.require)
      row.check.push_back({"experiment", metric,
                           row.metrics.contains(metric) ? row.metrics.at(metric).value : std::nan(""), least,
                           true});
    if (which.published) row.metrics["paper_" + which.published->unit] = *which.published;
    judge(row, picture);
    row.provenance["converged"] = is_precise(row);
    if (const auto covered = row.metrics.find("covered_fragments");
        row.status == Status::ok && covered != row.metrics.end())
      row.metrics["fragments_per_s"] = {covered->second.value / (median(frame_ms(row)) / 1000), "1/s"};
    // Detects inputs that changed during the measurement, for instance a texture that was edited after the
    // identity was computed.
    if (row.status == Status::ok) refuse_contradiction(row);
  } catch (const Unsupported& error) {
    fails(Status::unsupported, error.what());
  } catch (const OutOfBounds& error) {
    fails(Status::diverged, error.what());
  } catch (const std::bad_alloc&) {
    fails(Status::error, "out of memory");
  } catch (const std::exception& error) {
    fails(Status::error, error.what());
  }
  // Times and ratios of times without a verified picture are not kept.
  if (row.status != Status::ok) {
    row.samples.clear();
    std::erase_if(row.metrics, [](const auto& entry) { return entry.second.unit == "times"; });
  }
  return row;
}

RunSummary run_cases(const RunPlan& plan, const MakeSubject& make, Journal& journal,
                     const RunListener& listener) {
  RunSummary summary;
  const auto from = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < plan.cases.size(); ++i) {
    const Case& which = plan.cases[i];
    if (journal.holds(planned_key(plan, which))) {
      ++summary.kept;
      continue;
    }
    const double left_s = plan.budget_s - seconds_since(from);
    const bool late = left_s <= 0;
    summary.disturbed = summary.disturbed || (!late && listener.may_start && !listener.may_start(which));
    if (late || summary.disturbed) {
      ++summary.left;
      continue;
    }
    SamplingLimits limits = plan.limits;
    limits.limit_s = std::min(limits.limit_s, left_s / double(plan.cases.size() - i));
    if (listener.starting) listener.starting(i, which);
    const Row row = run_case(plan, which, limits, make);
    {
      const HoldInterrupt hold;  // defers interrupts until the row is written completely
      journal.append(row);
    }
    row.status == Status::ok || row.status == Status::unsupported ? ++summary.ok : ++summary.not_ok;
    if (listener.finished) listener.finished(i, row);
  }
  return summary;
}

}  // namespace pelage
