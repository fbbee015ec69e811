// pelage run: times the cases of an experiment on a device and writes one row of results per case.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <random>
#include <set>

#include "harness/commands/commands.hpp"
#include "harness/commands/progress.hpp"
#include "harness/commands/run_options.hpp"
#include "harness/error.hpp"
#include "harness/experiment/balance.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/measure/gpu_state.hpp"
#include "harness/measure/interrupt.hpp"
#include "harness/measure/interruptions.hpp"
#include "harness/measure/provenance.hpp"
#include "harness/measure/runner.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/prepare/scene_mesh.hpp"
#include "harness/record/results_folder.hpp"
#include "harness/report/case_table.hpp"
#include "harness/scene/scene_keys.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/subjects/case_identity.hpp"
#include "harness/subjects/pipelines.hpp"
#include "harness/tuning/tuning.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

struct Sweep {
  Experiment experiment;
  std::vector<Case> cases;  ///< with --shard, only the cases of this shard (a part of the run)
  SamplingLimits limits;
  std::size_t all_cases = 0;  ///< total number of cases of all shards
  std::string deal;           ///< hash of the division of the cases among the shards; "" without --shard
};

/// With --shard, removes the cases of all other shards from the sweep. With --balance, also prints the times
/// that earlier rows recorded for the cases of this shard and for all cases.
void take_shard(Sweep& sweep, const RunOptions& options) {
  sweep.all_cases = sweep.cases.size();
  const std::optional<Shard> shard = options.own_shard();
  if (!shard) return;
  std::vector<std::optional<double>> seconds(sweep.cases.size());
  if (!options.balance.empty())
    seconds = earlier_seconds(sweep.experiment.name, sweep.cases, read_results({options.balance}));
  const std::vector<int> shards = deal(seconds, shard->count);
  sweep.deal = hash_of_deal(sweep.cases, shards);
  std::vector<Case> own;
  double own_s = 0, all_s = 0;
  std::size_t unknown = 0;
  for (std::size_t i = 0; i < shards.size(); ++i) {
    all_s += seconds[i].value_or(0);
    unknown += !seconds[i];
    if (shards[i] != shard->index) continue;
    own.push_back(sweep.cases[i]);
    own_s += seconds[i].value_or(0);
  }
  if (!options.balance.empty())
    fmt::print(
        stderr,
        "pelage: {}: shard {} has {} of {} cases; earlier rows took {:.1f} s for these cases and {:.1f} s for all cases{}\n",
        sweep.experiment.name, options.shard, own.size(), shards.size(), own_s, all_s,
        unknown ? fmt::format("; {} cases have no earlier row", unknown) : "");
  sweep.cases = std::move(own);
}

Sweep plan_sweep(const RunOptions& options, const fs::path& file, std::uint64_t seed) {
  Sweep sweep;
  sweep.experiment = read_experiment(file);
  sweep.limits = preset_of(sweep.experiment, options.preset).limits;
  sweep.cases = chosen_cases(sweep.experiment, options.preset, options.filter, options.overrides());
  try {
    for (const std::string& warning : view_warnings(sweep.experiment.view, sweep.cases.front().axes))
      fmt::print(stderr, "pelage: warning: {}: {}\n", sweep.experiment.file.string(), warning);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", sweep.experiment.file.string(), error.what()));
  }
  take_shard(sweep, options);
  sweep.cases = shuffled(std::move(sweep.cases), seed);
  if (options.tuning != "defaults")
    for (Case& which : sweep.cases) which.variant += "/" + fs::path(options.tuning).stem().string();
  // All scenes are read before the first case runs, so that an error in a late case is reported at once.
  std::set<std::string> models;
  for (const Case& which : sweep.cases) models.insert(scene_of(sweep.experiment, which).model);
  for (const std::string& model : models)
    if (model != no_model) require_model(model);
  return sweep;
}

std::vector<cl::Device> chosen_devices(const std::string& wanted) {
  if (wanted != "all") return {cl::choose_device(wanted)};
  std::vector<cl::Device> all = cl::devices();
  if (all.empty())
    cl::choose_device("");  // throws NoDeviceError, whose message names the packages to install
  return all;
}

/// Returns the case with its mapping of pixels to work-items. If the experiment file gives a mapping, the
/// case stays unchanged. Otherwise the mapping is the value of --mapping or, without --mapping, the device's
/// default. If the variant's name then begins with "shells/tile" (`default_variant`), the function replaces
/// this beginning by "shells/MAPPING".
Case settled(Case which, const RunOptions& options, const cl::Device& device) {
  if (!which.mapping.empty()) return which;
  which.mapping = offered_mapping(options.mapping, device.info());
  if (which.variant.starts_with(default_variant))
    which.variant.replace(0, default_variant.size(), fmt::format("{}/{}", default_pipeline, which.mapping));
  return which;
}

/// Returns the device's name as a file name, followed by "-PLATFORM.INDEX" if several devices have this name.
std::string file_stem_of(const cl::Device& device, const std::vector<cl::Device>& all) {
  const auto same = std::ranges::count_if(
      all, [&](const cl::Device& other) { return other.info().name == device.info().name; });
  const std::string name = file_name_of(device.info().name);
  return same > 1 ? fmt::format("{}-{}.{}", name, device.info().platform_index, device.info().device_index)
                  : name;
}

void dry_run(const RunOptions& options, const std::vector<Sweep>& sweeps,
             const std::vector<cl::Device>& devices) {
  for (const Sweep& sweep : sweeps)
    for (const cl::Device& device : devices)
      for (const Case& which : sweep.cases)
        fmt::print("{}\t{}\t{}\t{}\n", sweep.experiment.name, which.name,
                   settled(which, options, device).variant, device.info().spec());
  fmt::print(
      stderr, "pelage: {} cases, preset {}; nothing was run\n",
      std::accumulate(sweeps.begin(), sweeps.end(), std::size_t(0),
                      [&](std::size_t n, const Sweep& s) { return n + s.cases.size() * devices.size(); }),
      options.preset);
}

/// Throws InputError if `resume` is false and the journal already contains a row of one of the plan's cases.
/// If `resume` is true, throws InputError under each of these conditions:
/// - a row was recorded with another preset;
/// - a row was recorded with another division of the cases among shards;
/// - the inputs of a case changed after its row was recorded.
void refuse_other_run(const Journal& journal, const RunPlan& plan, bool resume) {
  const auto present =
      std::ranges::count_if(plan.cases, [&](const Case& c) { return journal.holds(planned_key(plan, c)); });
  if (!resume && present > 0)
    throw InputError(fmt::format(
        "{}: already contains {} of these cases: continue it with --resume, or give another folder with -o",
        journal.file().string(), present));
  for (const Row& row : journal.rows()) {
    const std::string was = row.provenance.value("preset", "");
    if (resume && was != plan.provenance.value("preset", ""))
      throw InputError(
          fmt::format("{}: this run was started with --preset {}; resume it with the same preset",
                      journal.file().string(), was));
    // `deal` is a hash of the division of the cases among the shards. It is empty without --shard, for
    // instance if the user resumes a run whose shards were merged. The journal's rows may then come from any
    // shard.
    const std::string dealt = row.provenance.value("shard_deal", ""),
                      deal = plan.provenance.value("shard_deal", "");
    if (resume && !dealt.empty() && !deal.empty() && dealt != deal)
      throw InputError(fmt::format(
          "{}: this shard was started with other cases or another --balance; resume it with the same options",
          journal.file().string()));
  }
  if (!resume) return;
  std::map<std::string, const Row*> recorded;
  for (const Row& row : journal.rows())
    if (row.status != Status::error) recorded[row_key(row)] = &row;
  std::vector<KeptRow> kept;
  for (const Case& which : plan.cases)
    if (const auto row = recorded.find(planned_key(plan, which)); row != recorded.end())
      kept.push_back({row->second, &which});
  refuse_other_inputs(journal.file().string(), kept, plan.identity);
}

std::string told(const Row& row) {
  if (row.status != Status::ok) return fmt::format("{}: {}", to_text(row.status), row.reason);
  const double milliseconds = median(frame_ms(row));
  const std::string sample = sample_of(provenance_text(row, "pipeline"));
  std::string text = fmt::format("ok, {:.2f} ms", milliseconds);
  text += sample == "frame" ? fmt::format(", {:.1f} fps", 1000 / milliseconds) : fmt::format(" ({})", sample);
  if (const auto ratio = row.metrics.find("opengl_ratio"); ratio != row.metrics.end())
    text += fmt::format(", {:.2f}{} times OpenGL", ratio->second.value, interval_text(ratio->second));
  return text;
}

RunSummary run_sweep(const RunOptions& options, const Sweep& sweep, const cl::Device& device,
                     const std::string& device_file, bool several, const fs::path& folder, double budget_s,
                     std::uint64_t seed, const std::map<std::string, int>& tuning) {
  const std::optional<Shard> shard = options.own_shard();
  RunPlan plan;
  plan.run_id = fmt::format("{}-{}", utc_stamp(), getpid());
  plan.experiment = sweep.experiment.name;
  plan.device = device.info().name;
  plan.repeat = std::max(0, options.repeat_index);
  for (const Case& which : sweep.cases) plan.cases.push_back(settled(which, options, device));
  plan.limits = sweep.limits;
  plan.budget_s = budget_s;
  const fs::path place = folder / sweep.experiment.name;
  plan.images = place / "images";
  if (several) plan.image_suffix = "@" + device_file;
  plan.provenance = host_provenance(options.argv, options.anonymous);
  plan.provenance.update(device_provenance(device.info()));
  plan.provenance["preset"] = options.preset;
  if (!sweep.experiment.title.empty()) plan.provenance["title"] = sweep.experiment.title;
  if (const auto view = to_json(sweep.experiment.view); !view.empty()) plan.provenance["view"] = view;
  plan.provenance["order_seed"] = seed;
  if (!options.host.empty()) {
    if (!options.anonymous) plan.provenance["node"] = plan.provenance["host"];
    plan.provenance["host"] = options.host;
  }
  // pelage merge reads the following entries to find out which shards and cases are missing.
  if (shard) {
    plan.provenance["shard"] = fmt::format("{}/{}", shard->index, shard->count);
    plan.provenance["shard_deal"] = sweep.deal;
  }
  plan.provenance["shard_cases"] = plan.cases.size();
  plan.provenance["all_cases"] = sweep.all_cases;
  plan.provenance["repeats"] = options.repeat;
  Progress progress(plan.cases.size());
  const auto note = [&](const std::string& text) { progress.note("  " + text); };
  const auto context = make_context(device, sweep.experiment, tuning, note);
  plan.settings = [&](const Case& which) {
    auto settings = nlohmann::ordered_json::object();
    for (const auto& [key, value] : changed_keys(scene_of(sweep.experiment, which))) settings[key] = value;
    return settings;
  };
  if (!device.info().cpu) plan.gpu = [info = device.info()] { return gpu_state(info); };
  plan.identity = [&](const Case& which) { return case_identity(*context, which, plan.limits); };

  const fs::path file =
      place / fmt::format("{}@{}{}.jsonl", device_file,
                          file_name_of(plan.provenance.at("host").get<std::string>()),
                          shard ? fmt::format(".{}-of-{}", shard->index, shard->count) : "");
  const bool resume = !options.resume.empty();
  Journal journal(file, resume ? Journal::Mode::resume : Journal::Mode::fresh);
  refuse_other_run(journal, plan, resume);

  if (journal.dropped_bytes() > 0)
    progress.note(fmt::format("pelage: {}: removed an incomplete last row", file.string()));
  progress.skip(std::size_t(
      std::ranges::count_if(plan.cases, [&](const Case& c) { return journal.holds(planned_key(plan, c)); })));
  std::vector<CasePicture> pictures;
  const auto keep_picture = [&pictures](const Row& row) {
    if (row.status == Status::ok)
      pictures.push_back(
          {row.case_name, fmt::format("{} {}", row.variant, fmt::join(row.overrides, " ")), row.image_hash});
  };
  for (const Row& row : journal.rows()) keep_picture(row);
  RunListener listener;
  const QuietMachine quiet = quiet_machine_from_text(options.quiet_machine);
  listener.may_start = [&](const Case& which) {
    const std::string busy = disturbance(quiet, share_of_one_second);
    if (busy.empty()) return true;
    progress.note(fmt::format("pelage: {}: {}: {}", quiet == QuietMachine::warn ? "warning" : "not started",
                              which.name, busy));
    return quiet == QuietMachine::warn;
  };
  listener.starting = [&](std::size_t, const Case& which) { progress.start(which.name); };
  listener.finished = [&](std::size_t, const Row& row) {
    keep_picture(row);
    if (row.status != Status::ok && isatty(STDERR_FILENO))
      progress.note(fmt::format("{}: {}", row.case_name, told(row)));
    if (const std::string warning = interruption_warning(row); !warning.empty())
      fmt::print(stderr, "pelage: warning: {}\n", warning);
    if (const std::string warning = load_warning(row); !warning.empty())
      progress.note("pelage: warning: " + warning);
    progress.finish(told(row));
  };
  const RunSummary summary = run_cases(plan, subjects_of(context), journal, listener);
  if (const std::string equal = equal_pictures(pictures); !equal.empty())
    progress.note(fmt::format("pelage: {}: {}", sweep.experiment.name, equal));
  return summary;
}

int run_here(const RunOptions& options, const fs::path& folder) {
  const std::uint64_t seed = options.order_seed.value_or(std::random_device{}());
  std::vector<Sweep> sweeps;
  std::set<std::string> names;
  std::vector<fs::path> files;
  for (const std::string& name : options.experiments)
    for (const fs::path& file : experiments_named(name)) files.push_back(file);
  for (const fs::path& file : files) {
    sweeps.push_back(plan_sweep(options, file, seed));
    if (!names.insert(sweeps.back().experiment.name).second)
      throw InputError(fmt::format("{}: this experiment is given twice", sweeps.back().experiment.name));
  }
  const std::vector<cl::Device> devices = chosen_devices(options.device);
  const std::map<std::string, int> tuning =
      options.tuning == "defaults" ? std::map<std::string, int>{} : read_tuning(options.tuning);
  // An invalid --model is reported here once. Otherwise every case would report it.
  for (const Sweep& sweep : sweeps)
    if (!options.model.empty() && !sweep.cases.empty())
      load_scene_mesh(scene_of(sweep.experiment, sweep.cases.front()),
                      [](const std::string& text) { fmt::print(stderr, "{}\n", text); });
  if (options.dry_run) {
    dry_run(options, sweeps, devices);
    return 0;
  }

  RunSummary all;
  const auto from = std::chrono::steady_clock::now();
  for (const Sweep& sweep : sweeps) {
    for (const cl::Device& device : devices) {
      const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
      if (sweeps.size() * devices.size() > 1)
        fmt::print(stderr, "pelage: {} on {}\n", sweep.experiment.name, file_stem_of(device, devices));
      const RunSummary one = run_sweep(options, sweep, device, file_stem_of(device, devices),
                                       devices.size() > 1, folder, options.budget_s - spent, seed, tuning);
      all.ok += one.ok;
      all.kept += one.kept;
      all.not_ok += one.not_ok;
      all.left += one.left;
      all.disturbed = all.disturbed || one.disturbed;
    }
  }
  fmt::print(stderr, "pelage: {} cases ok, {} cases not ok{}{}\n", all.ok, all.not_ok,
             all.kept ? fmt::format(", {} kept from the interrupted run", all.kept) : "",
             all.left
                 ? fmt::format(", {} not run because {}; continue with --resume {}", all.left,
                               all.disturbed ? "other processes use the machine (--quiet-machine=require)"
                                             : "the time of --budget is used up",
                               folder.string())
                 : "");
  return all.not_ok > 0 || all.disturbed ? 1 : 0;
}

/// Throws InputError if the path of --balance (results of earlier runs) is the folder of this run, is inside
/// it or contains it. The results at this path would then grow during the run, and shards that start at
/// different times would divide the cases differently.
void refuse_growing_balance(const RunOptions& options, const fs::path& folder) {
  if (options.balance.empty()) return;
  const fs::path earlier = fs::weakly_canonical(fs::absolute(options.balance)),
                 own = fs::weakly_canonical(fs::absolute(folder));
  const auto contains = [](const fs::path& outer, const fs::path& inner) {
    return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
  };
  if (contains(earlier, own) || contains(own, earlier))
    throw InputError(fmt::format(
        "--balance {}: these results change while this run writes into {}; give results outside this folder",
        options.balance, folder.string()));
}

int run_command(const RunOptions& given) {
  const RunOptions options = checked(given);
  const fs::path folder = options.folder();
  refuse_recordings(folder);
  refuse_growing_balance(options, folder);
  if (options.dry_run) return run_here(options, folder);
  end_on_interrupt(folder.string(), "finished cases are kept; continue with --resume " + folder.string());
  const int code = options.repeat > 1 && options.repeat_index < 0 ? run_repeats(options, folder)
                                                                  : run_here(options, folder);
  if (options.repeat_index < 0) fmt::print("{}\n", folder.string());
  return code;
}

}  // namespace

void add_run(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<RunOptions>(
      app, chosen, "run", "Time the cases of an experiment and check every picture", run_command);
  declare(command, options);
}

}  // namespace pelage
