#include "harness/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "harness/atomic_file.hpp"
#include "harness/claims/claim_file.hpp"
#include "harness/claims/print.hpp"
#include "harness/journal/provenance.hpp"
#include "harness/measure/cpu_use.hpp"
#include "harness/report/csv.hpp"
#include "harness/report/input_sets.hpp"
#include "harness/report/plot.hpp"
#include "harness/report/scaling.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

void write_file(const fs::path& path, const std::string& text) {
  write_atomically(path, [&](const fs::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << text << std::flush;
    if (!stream) throw InputError(fmt::format("{}: cannot be written", path.string()));
  });
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
}

std::string title_of(const PaperTable& table, bool several_devices) {
  std::string title = table.experiment;
  if (table.reading != "default") title += ", " + table.reading + " reading";
  if (several_devices) title += ", " + table.device;
  return title;
}

void write_tables(Report& report, const fs::path& folder, bool several_devices) {
  for (const PaperTable& table : report.tables) {
    const std::string stem = file_stem_of(table, several_devices);
    write_file(folder / "tables" / (stem + ".csv"), csv_of(table));
    write_file(folder / "tables" / (stem + ".tex"), latex_of(table));
    report.table_stems.push_back(stem);
  }
}

/// Writes plots/STEM.csv and draws plots/STEM.svg and .pdf with plots/PROGRAM.py. If this fails, adds the
/// error text to the report's notes, unless they already contain it.
void draw(Report& report, const fs::path& folder, const std::string& program, const std::string& stem,
          const std::string& table, const std::string& title) {
  const fs::path place = folder / "plots";
  std::string problem;
  try {
    write_file(place / (stem + ".csv"), table);
    fs::copy_file(plot_program(program), place / (stem + ".py"), fs::copy_options::overwrite_existing);
    problem = draw_plot(place / (stem + ".py"), place / (stem + ".csv"), place / stem);
  } catch (const InputError& error) {
    problem = error.what();
  }
  if (problem.empty())
    report.plots.push_back({title, stem});
  else if (std::find(report.notes.begin(), report.notes.end(), problem) == report.notes.end())
    report.notes.push_back(problem);
}

void draw_plots(Report& report, const std::vector<FoundRow>& rows, const fs::path& folder,
                bool several_devices) {
  for (std::size_t i = 0; i < report.tables.size(); ++i)
    draw(report, folder, "frame_time", report.table_stems[i] + "-frame-time", csv_of(report.tables[i]),
         "Frame time against triangles: " + title_of(report.tables[i], several_devices));
  for (std::size_t i = 0; i < report.topologies.size(); ++i)
    draw(report, folder, "topologies", report.topology_stems[i] + "-cost", csv_of(report.topologies[i]),
         "Cost of each topology: " + report.topology_stems[i]);
  for (std::size_t i = 0; i < report.rivals.size(); ++i)
    draw(report, folder, "rivals", report.rival_stems[i], csv_of(report.rivals[i]),
         "Speed relative to the paper's pipeline: " + report.rivals[i].experiment);
  for (const SpringsChart& chart : springs_charts(rows))
    draw(report, folder, "springs", chart.stem, csv_by_phase(chart.rows), chart.title);
}

/// Returns the name, without extension, of a table's files in tables/. If the report has several devices, the
/// name contains the device and the host.
template <class Table>
std::string stem_of(const Table& table, const char* suffix, bool several_devices) {
  return file_name_of(table.experiment + suffix +
                      (several_devices ? "-" + table.device + "-" + table.host : std::string()));
}

void write_topologies(Report& report, const fs::path& folder, bool several_devices) {
  for (const TopologyTable& table : report.topologies) {
    const std::string stem = stem_of(table, "", several_devices);
    write_file(folder / "tables" / (stem + ".csv"), csv_of(table));
    write_file(folder / "tables" / (stem + ".tex"), latex_of(table));
    report.topology_stems.push_back(stem);
  }
}

void write_rivals(Report& report, const fs::path& folder, bool several_devices) {
  for (const RivalTable& table : report.rivals) {
    const std::string stem = stem_of(table, "-ratio", several_devices);
    write_file(folder / "tables" / (stem + ".csv"), csv_of(table));
    report.rival_stems.push_back(stem);
  }
}

void write_ways(Report& report, const fs::path& folder, bool several_devices) {
  for (const WayTable& table : report.ways) {
    const std::string stem = stem_of(table, "", several_devices);
    write_file(folder / "tables" / (stem + ".csv"), csv_of(table));
    report.way_stems.push_back(stem);
  }
}

/// Writes tables/layers.csv: the frame time with all layers divided by the frame times with half and with a
/// quarter of the layers. Every round of the measurement draws all three frames.
void write_in_turns(Report& report, const fs::path& folder) {
  const std::vector<Cell> cells = in_turns_cells(report.cells);
  if (cells.empty()) return;
  write_file(folder / "tables" / "layers.csv", in_turns_csv(cells));
  report.scaling += in_turns_text(cells);
}

/// Writes a table and a plot of the frame time against layers, pixels and triangles, and the fit that the
/// plot program computes.
void write_scaling(Report& report, const fs::path& folder) {
  const std::vector<Cell> cells = scaling_cells(report.cells);
  if (cells.empty()) return;
  report.scaling = scaling_text(cells);
  std::string problem;
  const fs::path place = folder / "plots";
  try {
    write_file(place / "scaling.csv", scaling_csv(cells));
    fs::copy_file(plot_program("scaling"), place / "scaling.py", fs::copy_options::overwrite_existing);
    problem = draw_plot(place / "scaling.py", place / "scaling.csv", place / "scaling");
  } catch (const InputError& error) {
    problem = error.what();
  }
  if (problem.empty()) {
    std::ifstream fit(place / "scaling.txt");
    report.scaling += std::string(std::istreambuf_iterator<char>(fit), {});
    report.plots.push_back({"Frame time against layers, pixels and triangles", "scaling"});
  } else {
    report.notes.push_back("scaling: " + problem);
  }
  write_file(folder / "tables" / "scaling.txt", report.scaling);
}

/// Copies one picture for each combination of experiment, model and value of the axis "reading". Among the
/// pictures with the largest number of layers, it copies the picture with the smallest width.
void copy_pictures(Report& report, const fs::path& folder) {
  std::map<std::tuple<std::string, std::string, std::string>, const Cell*> best;
  auto rank = [](const Cell& c) {
    return std::pair(-std::atof(c.axis("layers").c_str()), std::atof(c.axis("size").c_str()));
  };
  for (const Cell& c : report.cells) {
    if (c.status != Status::ok || !c.overrides.empty() || !fs::is_regular_file(c.image)) continue;
    const Cell*& chosen = best[{c.experiment, c.reading(), c.axis("model")}];
    if (!chosen || rank(c) < rank(*chosen)) chosen = &c;
  }
  for (const auto& [key, cell] : best) {
    const auto& [experiment, reading, model] = key;
    const std::string file = file_name_of(
        fmt::format("{}-{}{}.png", experiment, model, reading == "default" ? "" : "-" + reading));
    std::error_code error;
    fs::copy_file(cell->image, folder / "images" / file, fs::copy_options::overwrite_existing, error);
    if (error)
      report.notes.push_back(fmt::format("images/{}: {}", file, error.message()));
    else
      report.pictures.push_back(
          {fmt::format("{}{}, {} layers, {}", model, reading == "default" ? "" : " (" + reading + " reading)",
                       cell->axis("layers"), cell->axis("size")),
           file});
  }
}

/// Adds a note with the number of rows from a loaded machine. During the timing of these rows the share of
/// other processes in the CPU time was above most_other_share.
void note_load(Report& report, const std::vector<FoundRow>& rows) {
  std::size_t timed = 0, loaded = 0;
  for (const FoundRow& found : rows) {
    if (found.row.status != Status::ok) continue;
    ++timed;
    loaded += !load_warning(found.row).empty();
  }
  if (loaded > 0)
    report.notes.push_back(
        fmt::format("{} of {} rows were timed on a loaded machine: other processes used more than {:.0f}% of "
                    "its CPU time (other_cpu_share in the journal)",
                    loaded, timed, 100 * most_other_share));
}

/// Adds a note with the number of rows that several journals contain.
void note_copies(Report& report, const std::vector<FoundRow>& rows) {
  const auto copied =
      std::count_if(rows.begin(), rows.end(), [](const FoundRow& f) { return !f.copies.empty(); });
  if (copied > 0)
    report.notes.push_back(fmt::format(
        "{} of {} rows are in several journals; each of these rows is counted once", copied, rows.size()));
}

/// Judges the shipped claims about the experiments of the rows.
void judge_claims(Report& report, const std::vector<FoundRow>& rows, const fs::path& folder) {
  try {
    report.claims = claims::judge(claims::read_claims(claims::shipped_claims()), rows);
  } catch (const InputError& error) {
    report.notes.push_back(fmt::format("the report has no claims: {}", error.what()));
  }
  std::erase_if(report.claims, [](const claims::Judged& judged) { return judged.device.empty(); });
  if (report.claims.empty()) return;
  std::string csv;
  for (const std::vector<std::string>& line : claims::table_of(report.claims)) csv += csv_line(line);
  write_file(folder / "tables" / "claims.csv", csv);
}

}  // namespace

std::vector<Report> write_reports(const std::vector<FoundRow>& rows, const fs::path& folder,
                                  const ModelNote& note) {
  const std::vector<InputSet> sets = input_sets(rows);
  std::vector<Report> reports;
  std::vector<std::string> apart;
  for (std::size_t i = 1; i < sets.size(); ++i)
    apart.push_back(fmt::format(
        "{} of {} rows have the names of other rows but measured different inputs ({}); their report is "
        "inputs-{}/index.html",
        sets[i].rows.size(), rows.size(), sets[i].differs, i + 1));
  for (std::size_t i = 0; i < sets.size(); ++i)
    reports.push_back(
        write_report(sets[i].rows, i == 0 ? folder : folder / fmt::format("inputs-{}", i + 1), note,
                     i == 0 ? apart
                            : std::vector<std::string>{fmt::format(
                                  "the inputs of these rows ({}) differ from the inputs of the rows with "
                                  "the same names in the report of the parent folder",
                                  sets[i].differs)}));
  return reports;
}

Report write_report(const std::vector<FoundRow>& rows, const fs::path& folder, const ModelNote& note,
                    std::vector<std::string> notes) {
  for (const char* part : {"tables", "plots", "images"}) make_folder(folder / part);
  Report report;
  report.notes = std::move(notes);
  note_copies(report, rows);
  note_load(report, rows);
  report.cells = cells_of(rows);
  report.tables = paper_tables(report.cells, note);
  report.topologies = topology_tables(rows);
  report.rivals = rival_tables(rows);
  report.ways = way_tables(report.cells);
  add_titles(report.tables);
  std::set<std::pair<std::string, std::string>> devices;
  for (const Cell& c : report.cells) devices.emplace(c.device, c.host);
  write_tables(report, folder, devices.size() > 1);
  write_topologies(report, folder, devices.size() > 1);
  write_rivals(report, folder, devices.size() > 1);
  write_ways(report, folder, devices.size() > 1);
  write_file(folder / "tables" / "all-phases.csv", csv_by_phase(rows));
  report.solvers = solver_lines(rows);
  if (!report.solvers.empty()) write_file(folder / "tables" / "topology-solvers.csv", csv_of(report.solvers));
  judge_claims(report, rows, folder);
  draw_plots(report, rows, folder, devices.size() > 1);
  write_scaling(report, folder);
  write_in_turns(report, folder);
  copy_pictures(report, folder);
  write_file(folder / "references.bib", bibliography_of(rows));
  write_file(folder / "provenance.txt", provenance_of(rows));
  write_file(folder / "index.html", html_of(report, folder));
  return report;
}

}  // namespace pelage
