// Writes the body of the HTML report: the results, the pictures, all rows and the provenance.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

#include "harness/claims/print.hpp"
#include "harness/measure/statistics.hpp"
#include "harness/page/page.hpp"
#include "harness/report/case_table.hpp"
#include "harness/table/render.hpp"

namespace pelage {
namespace {

/// An entry of the table of contents.
struct Entry {
  std::string id, title;
  int level = 1;            ///< 1 for a chapter, 2 for a section of a chapter
  std::string detail = {};  ///< distinguishes entries that have the same title
};

/// Collects the HTML text of the page and the entries of its table of contents.
class Body {
 public:
  void add(const std::string& html) { html_ += html; }

  /// Adds a heading and its entry in the table of contents. Level 1 becomes an h2 element, level 2 an h3
  /// element.
  void heading(const std::string& title, int level, const std::string& detail = {}) {
    const std::string id = fmt::format("s{}", entries_.size() + 1);
    html_ += fmt::format("<h{0} id=\"{1}\">{2}</h{0}>\n", level + 1, id, html_text(title));
    entries_.push_back({id, title, level, detail});
  }

  /// Adds a paragraph in a softer colour, unless the text is empty.
  void remark(const std::string& text) {
    if (!text.empty()) html_ += fmt::format("<p class=\"soft\">{}</p>\n", html_text(text));
  }

  /// Adds buttons that save the named files from the page's data.
  void save_buttons(const std::vector<std::pair<std::string, std::string>>& labels) {
    html_ += "<p class=\"buttons\">";
    for (const auto& [file, label] : labels)
      html_ += fmt::format("<button type=\"button\" class=\"scripted\" data-file=\"{}\">{}</button>\n",
                           html_text(file), html_text(label));
    html_ += "</p>\n";
  }

  /// Adds a "details" element, which shows the text after a click on the title.
  void folded(const std::string& title, const std::string& text) {
    html_ += fmt::format("<details><summary>{}</summary><pre>{}</pre></details>\n", html_text(title),
                         html_text(text));
  }

  const std::string& html() const { return html_; }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::string html_;
  std::vector<Entry> entries_;
};

/// Returns the table of contents as nested HTML lists of links. If several entries have the same title, their
/// links also show Entry::detail.
std::string contents_of(const std::vector<Entry>& entries) {
  std::string html = "<ul>\n";
  int level = 1;
  for (const Entry& entry : entries) {
    if (&entry != &entries.front()) html += entry.level > level ? "<ul>\n" : "</li>\n";
    if (entry.level < level) html += "</ul></li>\n";
    level = entry.level;
    const auto same = std::ranges::count(entries, entry.title, &Entry::title);
    std::string title = html_text(entry.title);
    if (same > 1 && !entry.detail.empty())
      title += fmt::format(" <span class=\"soft\">({})</span>", html_text(entry.detail));
    html += fmt::format("<li><a href=\"#{}\">{}</a>", entry.id, title);
  }
  if (!entries.empty()) html += "</li>\n";
  if (level > 1) html += "</ul></li>\n";
  return html + "</ul>\n";
}

/// Returns the bytes as Base64 (RFC 4648), with padding.
std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < count ? std::uint32_t(std::uint8_t(bytes[i + k])) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? letters[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// Adds the SVG picture of the plot from the folder of the report, and a button that saves the plotted table.
void add_plot(Body& body, const Report& report, const ReportPlot& plot, const std::string& table) {
  std::ifstream stream(report.folder / "plots" / (plot.stem + ".svg"), std::ios::binary);
  const std::string svg{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const std::size_t start = svg.find("<svg ");
  if (start == std::string::npos) return;
  // The caption omits the part of the plot's title after ": ". The page already
  // shows this part above the plot, as the subtitle of the table.
  body.add(fmt::format(
      "<figure class=\"plot\">\n<figcaption>{}</figcaption>\n<svg role=\"img\" aria-label=\"{}\" {}\n",
      html_text(plot.title.substr(0, plot.title.find(": "))), html_text(plot.title), svg.substr(start + 5)));
  body.save_buttons({{table, "CSV of the plot"}});
  body.add("</figure>\n");
}

/// Returns the part of a table's subtitle after "EXPERIMENT on DEVICE, ", or else the name of the experiment.
std::string detail_of(const std::string& subtitle) {
  const std::size_t comma = subtitle.find(", ");
  return comma == std::string::npos ? subtitle.substr(0, subtitle.find(" on ")) : subtitle.substr(comma + 2);
}

void add_table(Body& body, const Table& table, bool latex) {
  body.heading(table.title, 2, detail_of(table.subtitle));
  body.remark(table.subtitle);
  body.add(html_of(table));
  std::vector<std::pair<std::string, std::string>> buttons{{table.stem + ".csv", "CSV"}};
  if (latex) buttons.emplace_back(table.stem + ".tex", "LaTeX");
  body.save_buttons(buttons);
}

void add_claims(Body& body, const std::vector<claims::Judged>& judged, const char* title) {
  if (judged.empty()) return;
  body.heading(title, 2);
  body.remark("The claims are in our words. Each verdict is computed from the rows of this page.");
  body.add(
      "<div class=\"wide\"><table class=\"claims\">\n<thead><tr><th>verdict</th><th>claim</th><th>effect</th><th>the claim</th><th>source</th></tr></thead>\n<tbody>\n");
  for (const claims::Judged& one : judged) {
    std::string details = one.reason;
    for (const std::string& note : one.notes) details += (details.empty() ? "" : "; ") + note;
    body.add(fmt::format(
        "<tr><td><span class=\"verdict {0}\">{0}</span></td><td class=\"prose\">{1}{2}</td><td data-sort=\"{3}\">{4}</td><td>{5}</td><td class=\"prose\">{6}, {7}</td></tr>\n",
        to_text(one.verdict), html_text(one.claim.statement),
        details.empty() ? "" : fmt::format("<br><span class=\"soft\">{}</span>", html_text(details)),
        one.value ? fmt::format("{:.6g}", *one.value) : "",
        one.value ? fmt::format("{}<br><span class=\"soft\">{}</span>", html_text(claims::effect_text(one)),
                                html_text(claims::description_of(one.claim)))
                  : "–",
        one.value ? html_text(one.claim.relation) : "–", html_text(one.claim.paper),
        html_text(one.claim.section)));
  }
  body.add("</tbody></table></div>\n");
  body.save_buttons({{"claims.csv", "CSV"}});
}

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
  add_claims(body, papers, "Claims of the papers");
  add_claims(body, ours, "Findings of our own");
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
      "<div class=\"wide tall\"><table id=\"rows\">\n<thead><tr><th>experiment</th><th>case</th><th>variant</th><th>status</th><th>frame, ms</th><th>samples</th><th>time (UTC)</th></tr></thead>\n"
      "<tbody>\n");
  std::size_t index = 0;
  for (const Report& report : reports)
    for (const FoundRow& found : report.rows) body.add(row_html(found.row, index++));
  body.add("</tbody></table></div>\n");
  body.save_buttons({{"rows.jsonl", "All rows as JSON lines"}});
}

void add_failures(Body& body, const std::vector<Report>& reports) {
  std::string items;
  for (const Report& report : reports)
    for (const Cell& c : report.cells)
      if (c.status != Status::ok)
        items += fmt::format("<li>{} {}: {}: {}</li>\n", html_text(c.experiment), html_text(c.case_name),
                             to_text(c.status), html_text(c.reason));
  if (items.empty()) return;
  body.heading("Cases without a time", 1);
  body.add("<ul>\n" + items + "</ul>\n");
}

void add_provenance(Body& body, const std::vector<Report>& reports) {
  body.heading("Provenance", 1);
  for (std::size_t r = 0; r < reports.size(); ++r) {
    const std::string set = reports.size() > 1 ? fmt::format(", set {}", r + 1) : "";
    body.folded("Runs, machines and programs" + set, provenance_of(reports[r].rows));
    body.folded("References (BibTeX)" + set, bibliography_of(reports[r].rows));
  }
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
          ? fmt::format(
                "{} cases. All of them are ok: their results agreed with the double-precision reference.",
                cells)
          : fmt::format(
                "{} cases. {} of them are ok: their results agreed with the double-precision reference. {}",
                cells, ok,
                cells - ok == 1 ? "The other case has no time."
                                : fmt::format("The other {} cases have no times.", cells - ok));
  std::string claims;
  for (std::size_t v = 0; v < verdicts.size(); ++v)
    if (verdicts[v] > 0)
      claims += fmt::format("{}{} {}", claims.empty() ? "" : ", ", to_text(claims::Verdict(v)), verdicts[v]);
  return claims.empty() ? text : text + " Claims of the papers: " + claims + ".";
}

}  // namespace

std::string body_of(const std::vector<Report>& reports, const PageParts& parts) {
  Body body;
  for (std::size_t r = 0; r < reports.size(); ++r) {
    body.add(fmt::format("<section data-part=\"{}\">\n", r));
    body.heading(reports.size() == 1 ? "Results" : fmt::format("Results, set {}", r + 1), 1);
    add_report(body, reports[r]);
    body.add("</section>\n");
  }
  add_gallery(body, reports, parts);
  add_failures(body, reports);
  add_rows(body, reports);
  add_provenance(body, reports);
  std::string notes;
  for (const std::string& note : parts.notes)
    notes += fmt::format("<p class=\"soft\">{}</p>\n", html_text(note));
  return fmt::format(
      "<header>\n<h1>pelage: results</h1>\n<p class=\"lead\">{}</p>\n{}</header>\n"
      "<nav id=\"contents\" aria-label=\"Contents\"><details open><summary>Contents</summary>\n{}</details></nav>\n"
      "<main>\n{}</main>\n",
      html_text(summary_of(reports)), notes, contents_of(body.entries()), body.html());
}

}  // namespace pelage
