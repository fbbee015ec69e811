// Writes the body of the HTML report: the results, the pictures, all rows and the provenance.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "harness/claims/print.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/page/page.hpp"
#include "harness/page/parts.hpp"
#include "harness/report/case_table.hpp"

namespace pelage {
namespace {

void add_report(Body& body, const Report& report) {
  for (const std::string& note : report.notes) body.remark(note);
  std::vector<ReportPlot> others = report.plots;
  for (const Section& section : report.sections) {
    add_table(body, section.table, true);
    for (const PlotSpec& plot : section.plots)
      if (std::erase_if(others, [&](const ReportPlot& drawn) { return drawn.stem == plot.stem; }) > 0)
        add_plot(body, report, {plot.title, plot.stem}, section.table.stem + ".csv");
  }
  if (!report.solvers.lines.empty()) add_table(body, report.solvers, false);
  for (const ReportPlot& plot : others) {
    body.heading(plot.title, 2);
    add_plot(body, report, plot, plot.stem + ".csv");
  }
  if (!report.scaling.empty()) {
    body.heading("Cost of layers, pixels and triangles", 2);
    body.folded("Frame time ratios and the fitted model of the frame time", report.scaling);
  }
  std::vector<claims::Judged> papers, ours;
  for (const claims::Judged& one : report.claims) (one.claim.ours() ? ours : papers).push_back(one);
  const std::string own =
      report.claims_file.empty() ? "Findings of our own" : "Claims of " + report.claims_file;
  add_claims(body, papers, "Claims of the papers");
  add_claims(body, ours, own.c_str());
}

/// Adds the pictures, and an empty element in which web/gallery.js shows two pictures for comparison.
void add_gallery(Body& body, const std::vector<Report>& reports, const PageParts& parts) {
  if (parts.pictures.empty()) return;
  body.heading("Pictures of the timed frames", 1);
  body.remark(fmt::format(
      "{} pictures, scaled down to a width of at most {} pixels and compressed (WebP). Each row contains the hash of its picture in full size.",
      parts.pictures.size(), std::ranges::max_element(parts.pictures, {}, &PagePicture::width)->width));
  body.add("<div id=\"wipe\" class=\"scripted\"></div>\n<div class=\"grid\">\n");
  for (const PagePicture& picture : parts.pictures) {
    const Cell& cell = reports[std::size_t(picture.report)].cells[std::size_t(picture.cell)];
    const std::string title = fmt::format("{}: {}{}", cell.experiment, name_of(cell),
                                          cell.variant.empty() ? "" : ", " + cell.variant);
    body.add(fmt::format(
        "<figure data-part=\"{}\" data-picture=\"{}\"><img src=\"data:image/webp;base64,{}\" alt=\"{}\" width=\"{}\" height=\"{}\" loading=\"lazy\"><figcaption>{}</figcaption></figure>\n",
        picture.report, picture.cell, base64(picture.webp), html_text(title), picture.width, picture.height,
        html_text(title)));
  }
  body.add("</div>\n");
}

std::string row_html(const Row& row, std::size_t index) {
  const std::vector<double> times = frame_ms(row);
  const std::string time =
      times.empty()
          ? fmt::format("<td class=\"bad\" data-sort=\"\">{}</td>", to_text(row.status))
          : fmt::format("<td data-sort=\"{:.8g}\">{}</td>", median(times), three_digits(median(times)));
  const auto utc = row.provenance.find("utc");
  return fmt::format(
      "<tr data-row=\"{}\"><td>{}</td><td>{}</td><td>{}</td><td>{}</td>{}<td>{}</td><td>{}</td></tr>\n",
      index, html_text(row.experiment), html_text(row.case_name), html_text(row.variant), to_text(row.status),
      time, times.size(),
      utc != row.provenance.end() && utc->is_string() ? html_text(utc->get<std::string>()) : "");
}

void add_rows(Body& body, const std::vector<Report>& reports) {
  body.heading("All rows", 1);
  body.remark("A click on a row shows its provenance, checks and raw samples.");
  body.add(
      "<p class=\"scripted\"><label>Filter <input id=\"filter\" type=\"search\" autocomplete=\"off\" placeholder=\"part of a name\"></label> <span id=\"shown\" class=\"soft\" role=\"status\"></span></p>\n"
      "<div class=\"wide tall\"><table id=\"rows\">\n<thead><tr><th>experiment</th><th>case</th><th>variant</th><th>status</th><th>time, ms</th><th>samples</th><th>time (UTC)</th></tr></thead>\n"
      "<tbody>\n");
  std::size_t index = 0;
  for (const Report& report : reports)
    for (const FoundRow& found : report.rows) body.add(row_html(found.row, index++));
  body.add("</tbody></table></div>\n");
  body.save_buttons({{"rows.jsonl", "All rows as JSON lines"}});
}

void add_provenance(Body& body, const std::vector<Report>& reports) {
  body.heading("Provenance", 1);
  for (std::size_t r = 0; r < reports.size(); ++r) {
    const std::string set = reports.size() > 1 ? fmt::format(", set {}", r + 1) : "";
    body.folded("Runs, machines and programs" + set, provenance_of(reports[r].rows));
    body.folded("References (BibTeX)" + set, bibliography_of(reports[r].rows));
  }
}

/// Returns the verdicts on the claims of the user's file, one paragraph each, and then the answers of all
/// sections, one paragraph each. If there are several answers, each has its section's title.
std::string answers_of(const std::vector<Report>& reports) {
  std::vector<const Table*> tables;
  for (const Report& report : reports)
    for (const Section& section : report.sections)
      if (!section.table.answer.empty()) tables.push_back(&section.table);
  std::string html;
  for (const Report& report : reports)
    for (const claims::Judged& one : report.claims)
      if (!report.claims_file.empty() && one.claim.ours())
        html += fmt::format(
            "<p class=\"lead\"><b>{}:</b> {}</p>\n", to_text(one.verdict),
            html_text(one.value ? fmt::format("{} ({}: {}{}; the claim: {})", one.claim.statement,
                                              claims::description_of(one.claim), claims::effect_text(one),
                                              claims::effects_text(one), one.claim.relation)
                                : fmt::format("{} ({})", one.claim.statement, one.reason)));
  for (const Table* table : tables)
    html += fmt::format("<p class=\"lead\">{}{}</p>\n",
                        tables.size() > 1 ? fmt::format("<b>{}.</b> ", html_text(table->title)) : "",
                        html_text(table->answer));
  return html;
}

std::string summary_of(const std::vector<Report>& reports) {
  std::size_t cells = 0, ok = 0;
  std::array<std::size_t, 4> verdicts{};
  for (const Report& report : reports) {
    cells += report.cells.size();
    for (const Cell& c : report.cells) ok += c.status == Status::ok;
    for (const claims::Judged& one : report.claims)
      if (!one.claim.ours()) ++verdicts[std::size_t(one.verdict)];
  }
  std::string text =
      ok == cells
          ? fmt::format("{} cases. All of them are ok: they passed their checks.", cells)
          : fmt::format("{} cases. {} of them are ok: they passed their checks. {}", cells, ok,
                        cells - ok == 1 ? "The other case has no time."
                                        : fmt::format("The other {} cases have no times.", cells - ok));
  std::string claims;
  for (std::size_t v = 0; v < verdicts.size(); ++v)
    if (verdicts[v] > 0)
      claims += fmt::format("{}{} {}", claims.empty() ? "" : ", ", to_text(claims::Verdict(v)), verdicts[v]);
  return claims.empty() ? text : text + " Claims of the papers: " + claims + ".";
}

}  // namespace

std::string page_title(const std::vector<Report>& reports) {
  std::set<std::string> experiments;
  for (const Report& report : reports)
    for (const Cell& c : report.cells) experiments.insert(c.experiment);
  if (experiments.size() == 1) return title_of(reports.front().cells);
  return fmt::format("Results of {} experiments", experiments.size());
}

std::string body_of(const std::vector<Report>& reports, const PageParts& parts) {
  Body body;
  for (std::size_t r = 0; r < reports.size(); ++r) {
    body.add(fmt::format("<section data-part=\"{}\">\n", r));
    body.heading(reports.size() == 1 ? "Results" : fmt::format("Results, set {}", r + 1), 1);
    add_report(body, reports[r]);
    body.add("</section>\n");
  }
  add_gallery(body, reports, parts);
  add_rows(body, reports);
  add_provenance(body, reports);
  std::string notes;
  for (const std::string& note : parts.notes)
    notes += fmt::format("<p class=\"soft\">{}</p>\n", html_text(note));
  return fmt::format(
      "<header>\n<h1>{}</h1>\n{}<p class=\"soft\">{}</p>\n{}</header>\n"
      "<nav id=\"contents\" aria-label=\"Contents\"><details><summary>Contents</summary>\n{}</details></nav>\n"
      "<main>\n{}</main>\n",
      html_text(page_title(reports)), answers_of(reports), html_text(summary_of(reports)), notes,
      contents_of(body.entries()), body.html());
}

}  // namespace pelage
