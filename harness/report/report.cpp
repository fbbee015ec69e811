#include "harness/report/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "harness/atomic_file.hpp"
#include "harness/claims/claim.hpp"
#include "harness/claims/print.hpp"
#include "harness/file_hash.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/measure/provenance.hpp"
#include "harness/report/case_table.hpp"
#include "harness/report/csv.hpp"
#include "harness/report/plot_spec.hpp"
#include "harness/table/render.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

/// Writes a file of the report that the page also contains.
void write_file(Report& report, const fs::path& path, const std::string& text) {
  write_text_atomically(path, text);
  report.files.emplace_back(path.filename().string(), text);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
}

/// Writes plots/STEM.csv and draws plots/STEM.svg and .pdf with plots/PROGRAM.py. Returns whether it
/// succeeded; if not, the report has a note with the error.
bool draw(Report& report, const fs::path& folder, const std::string& program, const std::string& stem,
          const std::string& table, const std::string& title) {
  const fs::path place = folder / "plots";
  std::string problem;
  try {
    write_text_atomically(place / (stem + ".csv"), table);
    for (const std::string& name : {program, std::string("style")})
      fs::copy_file(plot_program(name), place / (name + ".py"), fs::copy_options::overwrite_existing);
    problem = draw_plot(place / (program + ".py"), place / (stem + ".csv"), place / stem);
  } catch (const InputError& error) {
    problem = error.what();
  }
  if (problem.empty())
    report.plots.push_back({title, stem});
  else if (std::find(report.notes.begin(), report.notes.end(), problem) == report.notes.end())
    report.notes.push_back(problem);
  return problem.empty();
}

void write_sections(Report& report, const fs::path& folder) {
  for (const Section& section : report.sections) {
    write_text_atomically(folder / "tables" / (section.table.stem + ".txt"), text_of(section.table));
    write_file(report, folder / "tables" / (section.table.stem + ".csv"), csv_of(section.table));
    write_file(report, folder / "tables" / (section.table.stem + ".tex"), latex_of(section.table));
    for (const PlotSpec& plot : section.plots) {
      write_text_atomically(folder / "plots" / (plot.stem + ".json"), json_of(plot));
      draw(report, folder, "plot", plot.stem, csv_of(section.table), plot.title);
    }
  }
}

/// Writes tables/layers-ratios.csv: the frame time with all layers divided by those with half and with a
/// quarter of them, drawn in the same rounds.
void write_in_turns(Report& report, const fs::path& folder) {
  const std::vector<Cell> cells = in_turns_cells(report.cells);
  if (cells.empty()) return;
  write_text_atomically(folder / "tables" / "layers-ratios.csv", in_turns_csv(cells));
  report.scaling += in_turns_text(cells);
}

/// Writes a table and a plot of the frame time against layers, pixels and triangles, and appends the text of
/// the plot program's fit to the table.
void write_scaling(Report& report, const fs::path& folder) {
  const std::vector<Cell> cells = scaling_cells(report.cells);
  if (cells.empty()) return;
  report.scaling = scaling_text(cells);
  report.files.emplace_back("frame-time-model.csv", scaling_csv(cells));
  if (draw(report, folder, "scaling", "frame-time-model", scaling_csv(cells),
           "Frame time against layers, pixels and triangles")) {
    std::ifstream fit(folder / "plots/frame-time-model.txt");
    report.scaling += std::string(std::istreambuf_iterator<char>(fit), {});
  }
  write_text_atomically(folder / "tables" / "frame-time-model.txt", report.scaling);
}

/// Clears Cell::image if the file is not the picture that a row recorded, and adds the file to `left_out`.
void drop_other_pictures(std::vector<Cell>& cells, std::vector<LeftOut>& left_out) {
  for (Cell& c : cells) {
    if (c.picture_hashes.empty() || !fs::is_regular_file(c.image) ||
        c.picture_hashes.contains(hash_of_file(c.image)))
      continue;
    left_out.push_back({c.experiment, c.case_name, c.image.string(),
                        "picture: the file is not the picture that the row recorded"});
    c.image.clear();
  }
}

/// Copies one picture for each combination of experiment, changes on the command line, model and reading: of
/// several pictures that with the most layers, and among these the one with the smallest width.
void copy_pictures(Report& report, const fs::path& folder) {
  std::map<std::tuple<std::string, std::string, std::string, std::string>, std::vector<const Cell*>> groups;
  for (const Cell& c : report.cells)
    if (c.status == Status::ok && fs::is_regular_file(c.image))
      groups[{c.experiment, c.reading(), c.axis("model"), changes_of(c.overrides)}].push_back(&c);
  for (const auto& [key, cells] : groups) {
    const auto& [experiment, reading, model, changes] = key;
    const Cell* cell = *std::ranges::min_element(cells, {}, [](const Cell* c) {
      return std::pair(-std::atof(c->axis("layers").c_str()), std::atof(c->axis("size").c_str()));
    });
    std::string name = experiment;
    for (const std::string& part : {model, reading, changes})
      if (!part.empty()) name += "-" + part;
    const std::string file = file_name_of(name + ".png");
    std::error_code error;
    fs::copy_file(cell->image, folder / "images" / file, fs::copy_options::overwrite_existing, error);
    if (error) report.notes.push_back(fmt::format("images/{}: {}", file, error.message()));
  }
}

void note_load(Report& report, const std::vector<FoundRow>& rows) {
  std::size_t timed = 0, loaded = 0;
  for (const FoundRow& found : rows) {
    if (found.row.status != Status::ok) continue;
    ++timed;
    loaded += !load_warning(found.row).empty();
  }
  if (loaded > 0)
    report.notes.push_back(fmt::format(
        "{} of {} rows were timed on a loaded machine: other processes used more than {:g}% of its CPU time (other_cpu_share in the journal)",
        loaded, timed, 100 * most_other_share));
}

/// Adds what the preparation of the users' meshes found (Row::provenance, mesh_warnings), once for each mesh.
void note_meshes(Report& report, const std::vector<FoundRow>& rows) {
  std::set<std::string> named;
  for (const FoundRow& found : rows) {
    const auto warnings = found.row.provenance.find("mesh_warnings");
    const auto model = found.row.axes.find("model");
    if (warnings == found.row.provenance.end() || !warnings->is_array() || warnings->empty()) continue;
    const std::string name = model != found.row.axes.end() ? model->second : found.row.case_name;
    if (!named.insert(name).second) continue;
    std::vector<std::string> texts;
    for (const auto& text : *warnings)
      if (text.is_string()) texts.push_back(text.get<std::string>());
    report.notes.push_back(fmt::format("the mesh of {}: {}", name, fmt::join(texts, "; ")));
  }
}

void note_copies(Report& report, const std::vector<FoundRow>& rows) {
  const auto copied = std::ranges::count_if(rows, [](const FoundRow& f) { return !f.copies.empty(); });
  if (copied > 0)
    report.notes.push_back(fmt::format(
        "{} of {} rows are in several journals; each of these rows is counted once", copied, rows.size()));
}

/// Writes the verdicts on the claims to tables/claims.csv, without claims about experiments that are not in
/// the rows.
void judge_claims(Report& report, const std::vector<FoundRow>& rows, const fs::path& folder,
                  const std::optional<claims::ClaimFile>& own) {
  if (own) report.claims_file = own->file.filename().string();
  try {
    report.claims = claims::judge(own ? *own : claims::read_claims(claims::shipped_claims()), rows);
  } catch (const InputError& error) {
    report.notes.push_back(fmt::format("the report has no claims: {}", error.what()));
  }
  std::erase_if(report.claims, [](const claims::Judged& judged) { return judged.device.empty(); });
  if (!report.claims.empty())
    write_file(report, folder / "tables" / "claims.csv", csv_lines(claims::table_of(report.claims)));
}

}  // namespace

std::vector<Report> write_reports(const std::vector<FoundRow>& rows, const fs::path& folder,
                                  const ModelNote& note, const std::vector<LeftOut>& left_out,
                                  const std::optional<claims::ClaimFile>& claims) {
  const std::vector<InputSet> sets = input_sets(rows);
  std::vector<Report> reports;
  std::vector<std::string> apart;
  for (std::size_t i = 1; i < sets.size(); ++i)
    apart.push_back(fmt::format(
        "{} of {} rows have the same names (case, variant, device and so on) as other rows but measured different inputs ({}); their files are in the folder inputs-{}, and the page shows them separately",
        sets[i].rows.size(), rows.size(), sets[i].differs, i + 1));
  reports.push_back(write_report(sets.front().rows, folder, note, apart, left_out, claims));
  for (std::size_t i = 1; i < sets.size(); ++i)
    reports.push_back(write_report(
        sets[i].rows, folder / fmt::format("inputs-{}", i + 1), note,
        {fmt::format(
            "the inputs of these rows ({}) differ from the inputs of the rows with the same names (case, variant, device and so on) in the first set",
            sets[i].differs)},
        {}, claims));
  return reports;
}

Report write_report(const std::vector<FoundRow>& rows, const fs::path& folder, const ModelNote& note,
                    std::vector<std::string> notes, std::vector<LeftOut> left_out,
                    const std::optional<claims::ClaimFile>& claims) {
  for (const char* part : {"tables", "plots", "images"}) make_folder(folder / part);
  Report report;
  report.folder = folder;
  report.rows = rows;
  report.notes = std::move(notes);
  note_copies(report, rows);
  note_load(report, rows);
  note_meshes(report, rows);
  report.cells = cells_of(rows);
  std::set<std::string> devices;
  std::set<std::pair<std::string, std::string>> machines;
  for (const Cell& c : report.cells) {
    devices.insert(c.device);
    machines.emplace(c.device, c.host);
  }
  report.sections =
      sections_of(report.cells, {note, devices.size() > 1, machines.size() > devices.size(), &report.notes});
  drop_other_pictures(report.cells, left_out);
  copy_pictures(report, folder);
  for (LeftOut& one : without_numbers(report.cells, rows)) left_out.push_back(std::move(one));
  if (!left_out.empty()) report.sections.push_back(left_out_section(left_out));
  write_sections(report, folder);
  write_text_atomically(folder / "tables" / "all-phases.csv", csv_by_phase(rows));
  report.solvers = solver_table(rows);
  if (!report.solvers.lines.empty())
    write_file(report, folder / "tables" / (report.solvers.stem + ".csv"), csv_of(report.solvers));
  judge_claims(report, rows, folder, claims);
  write_scaling(report, folder);
  write_in_turns(report, folder);
  write_file(report, folder / "references.bib", bibliography_of(rows));
  write_file(report, folder / "provenance.txt", provenance_of(rows));
  return report;
}

}  // namespace pelage
