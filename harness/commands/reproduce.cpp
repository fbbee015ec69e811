// pelage reproduce: runs everything that a paper's tables, figures and claims need, and writes one page.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>

#include "harness/claims/judge.hpp"
#include "harness/commands/commands.hpp"
#include "harness/commands/lengths.hpp"
#include "harness/commands/run_options.hpp"
#include "harness/error.hpp"
#include "harness/experiment/experiment.hpp"
#include "harness/experiment/paper_plan.hpp"
#include "harness/measure/interrupt.hpp"
#include "harness/mesh/models.hpp"
#include "harness/page/papers.hpp"
#include "harness/record/results_folder.hpp"
#include "harness/report/csv.hpp"
#include "harness/report/report.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

constexpr int no_device = 3;  // exit code of a command without a device (commands.hpp)
// The check of a picture needs 64 windows with fur.
constexpr int smoke_width = 200, smoke_height = 150;

struct ReproduceOptions {
  std::vector<std::string> papers;
  std::string preset = "quick", output, resume, device;
  bool anonymous = false, dry_run = false;

  bool smoke() const { return preset == "smoke"; }
};

/// A run of `pelage run`.
struct Step {
  std::string experiment, preset;
  std::vector<std::string> options;
  std::size_t cases = 0;
};

/// The size of the pictures of the preset smoke.
Axis smoke_axis() {
  return {"size", {fmt::format("{}x{}", smoke_width, smoke_height)}};
}

bool is_figure(const Experiment& experiment) {
  return experiment.collection == "figures";
}

/// The preset of this name, or the experiment's own quick one. The smoke presets of figures draw only some of
/// their cases, so that all of them are drawn, at a small size.
Step step_of(const std::string& name, const ReproduceOptions& options) {
  const Experiment experiment = read_experiment(experiment_file(name));
  const bool figure = is_figure(experiment);
  const bool has = experiment.presets.contains(options.preset);
  Step step{name, has && !figure ? options.preset : "quick", {}, 0};
  Overrides overrides;
  if (figure && options.smoke()) {
    overrides.axes = {smoke_axis()};
    step.options = {"--axis", "size=" + overrides.axes.front().values.front()};
  }
  step.cases = cases_of(experiment, preset_of(experiment, step.preset), overrides).size();
  return step;
}

/// The experiments whose rows the claims of the paper use.
std::vector<std::string> claimed(const claims::ClaimFile& file, const PaperPlan& plan) {
  std::vector<std::string> names;
  for (const claims::Claim& claim : file.claims)
    if (claim.paper == plan.paper)
      names.insert(names.end(), claim.experiments.begin(), claim.experiments.end());
  return names;
}

std::vector<Step> steps_of(const std::vector<PaperPlan>& plans, const claims::ClaimFile& claims,
                           const ReproduceOptions& options) {
  std::vector<Step> steps;
  std::set<std::string> names;
  for (const PaperPlan& plan : plans)  // the preset smoke tests no claim
    for (const std::string& name :
         experiments_of(plan, options.smoke() ? std::vector<std::string>() : claimed(claims, plan)))
      if (names.insert(name).second) steps.push_back(step_of(name, options));
  return steps;
}

/// Runs the step, or what is left of it. Returns the exit code of `pelage run`.
int run_step(const Step& step, const ReproduceOptions& options, const fs::path& folder) {
  std::vector<std::string> words{"run", step.experiment, "--preset", step.preset};
  words.insert(words.end(), step.options.begin(), step.options.end());
  const bool begun = fs::is_directory(folder / step.experiment);
  words.insert(words.end(), {begun ? "--resume" : "-o", folder.string()});
  if (!options.device.empty()) words.insert(words.end(), {"--device", options.device});
  if (options.anonymous) words.emplace_back("--anonymous");
  return run_self(words);
}

/// Returns the case of the panel.
Case case_of(const FigurePanel& panel, const ReproduceOptions& options) {
  const Step step = step_of(panel.experiment, options);
  const Experiment experiment = read_experiment(experiment_file(panel.experiment));
  Overrides overrides;
  if (!step.options.empty()) overrides.axes = {smoke_axis()};
  for (const Case& which : cases_of(experiment, preset_of(experiment, step.preset), overrides))
    if (which.name.starts_with(panel.name + "-") || which.name == panel.name) return which;
  throw InputError(fmt::format("experiments/papers: {} has no case {}", panel.experiment, panel.name));
}

/// Returns the picture of the panel, and draws it if it is missing. Returns "" if it cannot be drawn.
fs::path picture_of(const FigurePanel& panel, const fs::path& stem, const ReproduceOptions& options,
                    const fs::path& folder) {
  if (panel.diagram.empty() && panel.scene.empty()) {
    const fs::path image = folder / panel.experiment / "images" / (case_of(panel, options).name + ".png");
    return fs::is_regular_file(image) ? image : fs::path();
  }
  fs::path file = stem;
  file += draws_table(panel.diagram) ? ".svg" : ".png";
  if (fs::is_regular_file(file)) return file;
  std::vector<std::string> words;
  if (panel.diagram.empty())
    words = {"render", panel.scene};
  else if (panel.scene.empty())
    words = {"diagram", panel.diagram, panel.experiment, "--case", case_of(panel, ReproduceOptions{}).name};
  else
    words = {"diagram", panel.diagram, panel.scene};
  words.insert(words.end(), panel.options.begin(), panel.options.end());
  const bool drawn = panel.diagram.empty() || panel.diagram == "lines" || panel.diagram == "wind";
  if (options.smoke() && drawn)
    words.insert(words.end(), {"--set", fmt::format("image.width={}", smoke_width), "--set",
                               fmt::format("image.height={}", smoke_height)});
  if (!options.device.empty() && drawn) words.insert(words.end(), {"--device", options.device});
  fs::path part = stem;  // the file gets its name when it is complete
  part += draws_table(panel.diagram) ? "-part.svg" : "-part.png";
  words.insert(words.end(), {"-o", part.string()});
  if (run_self(words) != 0) return {};
  fs::rename(part, file);
  return file;
}

std::vector<std::vector<fs::path>> figures_of(const PaperPlan& plan, const ReproduceOptions& options,
                                              const fs::path& folder, std::vector<std::string>& notes) {
  std::vector<std::vector<fs::path>> all;
  for (const PaperFigure& figure : plan.figures) {
    std::vector<fs::path> files;
    for (std::size_t i = 0; i < figure.panels.size(); ++i) {
      const fs::path stem =
          folder / "figures" / fmt::format("{}-{}-{}", plan.name, all.size() + 1, char('a' + i));
      files.push_back(picture_of(figure.panels[i], stem, options, folder));
      if (files.back().empty())
        notes.push_back(fmt::format("{}, {}: the picture \"{}\" is missing", plan.title, figure.title,
                                    figure.panels[i].label));
    }
    all.push_back(std::move(files));
  }
  return all;
}

/// Names the panels whose pictures did not pass their checks.
void note_failed_checks(const std::vector<PaperPlan>& plans, const ReproduceOptions& options,
                        const std::vector<FoundRow>& rows, std::vector<std::string>& notes) {
  for (const PaperPlan& plan : plans)
    for (const PaperFigure& figure : plan.figures)
      for (const FigurePanel& panel : figure.panels) {
        if (panel.experiment.empty() || !panel.diagram.empty()) continue;
        const std::string name = case_of(panel, options).name;
        for (const FoundRow& found : rows)
          if (found.row.experiment == panel.experiment && found.row.case_name == name &&
              found.row.status != Status::ok)
            notes.push_back(fmt::format("{}, {}: the picture \"{}\" failed: {}", plan.title, figure.title,
                                        panel.label, found.row.reason));
      }
}

/// Adds a row with the status `skipped` for each case of the plans' tables that the preset quick would
/// measure and no row has, so that the tables show the paper's number beside it.
void add_unmeasured(const std::vector<PaperPlan>& plans, std::vector<FoundRow>& rows) {
  for (const PaperPlan& plan : plans)
    for (const PaperTable& table : plan.tables) {
      const auto of_table = [&](const FoundRow& found) { return found.row.experiment == table.experiment; };
      const auto any = std::ranges::find_if(rows, of_table);
      if (any == rows.end()) continue;
      const FoundRow model = *any;
      const Experiment experiment = read_experiment(experiment_file(table.experiment));
      for (const Case& which : cases_of(experiment, preset_of(experiment, "quick"))) {
        if (std::ranges::any_of(rows, [&](const FoundRow& found) {
              return of_table(found) && found.row.case_name == which.name;
            }))
          continue;
        FoundRow added{{}, model.journal};
        Row& row = added.row;
        row.experiment = table.experiment;
        row.case_name = which.name;
        row.variant = which.variant == default_variant ? model.row.variant : which.variant;
        row.axes = which.axes;
        row.device = model.row.device;
        row.provenance = model.row.provenance;
        row.status = Status::skipped;
        row.reason = "not measured with the preset smoke";
        if (which.published) row.metrics["paper_fps"] = *which.published;
        rows.push_back(std::move(added));
      }
    }
}

/// Whether some row is neither ok nor diverged: where a step is too long, a divergence is what is measured.
bool has_failures(const fs::path& folder) {
  return std::ranges::any_of(read_all_results({folder.string()}).rows, [](const FoundRow& found) {
    return found.row.status != Status::ok && found.row.status != Status::diverged;
  });
}

double seconds_since(std::chrono::steady_clock::time_point from) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
}

/// Returns the estimated time in which all figures are drawn, s.
double figures_length(const Lengths& lengths, const ReproduceOptions& options,
                      const std::vector<PaperPlan>& plans, double speed) {
  double seconds = 0;
  for (const PaperPlan& plan : plans)
    seconds += lengths.of(options.preset, plan.name + " figures", plan.figures.size(), speed);
  return seconds;
}

/// Returns the share of the step's cases that have no row in `folder` yet, 0 to 1.
double share_left(const Step& step, const fs::path& folder) {
  const fs::path place = folder / step.experiment;
  if (!fs::is_directory(place) || step.cases == 0) return 1;
  std::size_t rows = 0;
  for (const auto& entry : fs::directory_iterator(place))
    if (entry.path().extension() == ".jsonl") {
      std::ifstream journal(entry.path());
      for (std::string line; std::getline(journal, line);) ++rows;
    }
  return 1 - double(std::min(rows, step.cases)) / double(step.cases);
}

int print_steps(const ReproduceOptions& options, const std::vector<PaperPlan>& plans,
                const std::vector<Step>& steps) {
  const Lengths lengths(shipped_lengths());
  const double speed = machine_speed();
  double seconds = figures_length(lengths, options, plans, speed);
  std::size_t cases = 0, figures = 0;
  for (const PaperPlan& plan : plans) figures += plan.figures.size();
  fmt::print("experiment\tpreset\tcases\tlength\n");
  for (const Step& step : steps) {
    const double own = lengths.of(options.preset, step.experiment, step.cases, speed);
    std::string preset = step.preset;
    for (const std::string& option : step.options)
      if (option != "--axis") preset += ", " + option;
    fmt::print("{}\t{}\t{}\t{}\n", step.experiment, preset, step.cases, length_text(own));
    cases += step.cases;
    seconds += own;
  }
  fmt::print(stderr, "pelage: {} experiments with {} cases, {} figures: about {}; nothing was run\n",
             steps.size(), cases, figures, length_text(seconds));
  return 0;
}

int reproduce(const ReproduceOptions& options) {
  std::vector<PaperPlan> plans;
  for (const std::string& name : options.papers) plans.push_back(paper_plan(name));
  if (plans.empty()) plans = paper_plans();
  const claims::ClaimFile claims = claims::read_claims(claims::shipped_claims());
  const std::vector<Step> steps = steps_of(plans, claims, options);
  if (options.dry_run) return print_steps(options, plans, steps);
  RunOptions where;
  where.output = options.output;
  where.resume = options.resume;
  where.anonymous = options.anonymous;
  const fs::path folder = where.folder();
  refuse_recordings(folder);
  fs::create_directories(folder / "figures");
  end_on_interrupt(
      folder.string(),
      "what is finished is kept; continue with: pelage reproduce ... --resume " + folder.string());
  std::vector<std::string> notes;
  Lengths lengths(shipped_lengths());
  const double speed = machine_speed();
  const auto estimate = [&](const Step& step) {
    return lengths.of(options.preset, step.experiment, step.cases, speed);
  };
  double left = figures_length(lengths, options, plans, speed);
  for (const Step& step : steps) left += estimate(step) * share_left(step, folder);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    fmt::print(stderr, "pelage: experiment {} of {}: {}, {} cases; about {} left\n", i + 1, steps.size(),
               steps[i].experiment, steps[i].cases, length_text(left));
    left -= estimate(steps[i]) * share_left(steps[i], folder);
    const bool begun = fs::is_directory(folder / steps[i].experiment);
    const auto from = std::chrono::steady_clock::now();
    const int code = run_step(steps[i], options, folder);
    if (code == no_device || code == 130 || code == 143) return code;  // all other steps would end likewise
    if (!begun)
      add_length(folder / "lengths.csv", options.preset, steps[i].experiment, seconds_since(from), speed);
    if (code <= 1 && (share_left(steps[i], folder) > 0 || has_failures(folder / steps[i].experiment)))
      notes.push_back(fmt::format("{}: some cases have no time", steps[i].experiment));
    if (code > 1)
      notes.push_back(fmt::format("{}: pelage run ended with code {}", steps[i].experiment, code));
  }
  PapersPage page;
  for (const PaperPlan& plan : plans) {
    const auto from = std::chrono::steady_clock::now();
    page.papers.push_back({plan, figures_of(plan, options, folder, notes)});
    if (options.resume.empty())
      add_length(folder / "lengths.csv", options.preset, plan.name + " figures", seconds_since(from), speed);
  }
  Results results = read_all_results({folder.string()});
  note_failed_checks(plans, options, results.rows, notes);
  page.claims = claims::judge(claims, input_sets(results.rows).front().rows);
  if (options.smoke()) add_unmeasured(plans, results.rows);
  const std::vector<Report> reports =
      write_reports(results.rows, folder / "page", footnote_of, results.left_out);
  page.notes = notes;
  page.preset = options.preset;
  page.smoke = options.smoke();
  const fs::path file = folder / "page" / "index.html";
  write_papers_page(reports, page, file);
  for (const std::string& note : notes) fmt::print(stderr, "pelage: {}\n", note);
  fmt::print("{}\n", file.string());
  return notes.empty() ? 0 : 1;
}

}  // namespace

void add_reproduce(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<ReproduceOptions>(
      app, chosen, "reproduce",
      "Run what the tables, figures and claims of papers need, and write one page with all of them",
      reproduce);
  add_value(command, "papers", options.papers, "PAPER",
            "Papers: banisch2006, demoreuille2011, silva2010, wetfur2010 (default: all)");
  add_value(
      command, "--preset", options.preset, "smoke|quick|paper",
      "smoke: small pictures and few frames, no claims; quick: claims are judged; paper: for published numbers")
      ->check(CLI::IsMember({"smoke", "quick", "paper"}));
  add_value(command, "-o,--output", options.output, "DIR", "New folder for rows, pictures and the page");
  add_value(command, "--resume", options.resume, "DIR", "Continue in this folder; what is finished is kept")
      ->excludes("--output");
  add_device_option(command, options.device);
  command.add_flag("--anonymous", options.anonymous, "Write neither the host's name nor paths into the rows");
  command.add_flag("--dry-run", options.dry_run,
                   "Print the experiments and how long they take, without running them");
}

}  // namespace pelage
