// Writes index.html: the report as one page that uses only files in the report's folder.
#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "harness/claims/print.hpp"
#include "harness/report/report.hpp"
#include "harness/table/render.hpp"

namespace pelage {
namespace {

constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; --line: #d5d2cb; --soft: #6b675f; --back: #fbfaf7; --text: #23211d; --accent: #8a4b14; }
@media (prefers-color-scheme: dark) {
  :root { --line: #44413b; --soft: #a5a096; --back: #1d1c19; --text: #ece8df; --accent: #e0a56a; }
  figure.plot { background: #fff; border-radius: 6px; padding: .5rem; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 72rem; padding: 2.5rem 1.25rem 4rem; background: var(--back); color: var(--text);
  font: 16px/1.55 "Source Sans 3", "Helvetica Neue", Helvetica, Arial, sans-serif; }
h1 { font-size: 1.9rem; margin: 0 0 .25rem; } h2 { font-size: 1.25rem; margin: 2.75rem 0 .5rem; }
p.lead, .soft, figcaption { color: var(--soft); } p.lead { margin: 0 0 1rem; }
a { color: var(--accent); }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .93rem; margin: .75rem 0; }
th, td { padding: .28rem .8rem; text-align: right; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
thead tr:first-child th { border-top: 2px solid var(--text); }
thead tr:last-child th { border-bottom: 1px solid var(--text); }
tbody tr:last-child td { border-bottom: 2px solid var(--text); }
thead th { font-weight: 600; } thead th.group { text-align: center; }
th:first-child { min-width: 7.5rem; } td.ours, td.bad { min-width: 7rem; }
td.ours { font-weight: 600; } td.bad { color: #b3261e; font-weight: 400; }
.grid { display: grid; grid-template-columns: repeat(auto-fill, minmax(15rem, 1fr)); gap: 1rem; }
figure { margin: 0; } figure img, figure svg { max-width: 100%; height: auto; display: block; }
.grid img { width: 100%; border-radius: 6px; } figcaption { font-size: .87rem; margin-top: .3rem; }
ol.notes { list-style: none; padding: 0; font-size: .87rem; color: var(--soft); }
)";

/// Returns the SVG drawing without its XML prologue, which is not allowed inside an HTML page.
std::string svg_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const std::size_t start = text.find("<svg");
  return start == std::string::npos ? std::string{} : text.substr(start);
}

std::string failures_html(const Report& report) {
  std::string items;
  for (const Cell& c : report.cells)
    if (c.status != Status::ok)
      items += fmt::format("<li>{} {}: {}: {}</li>\n", html_text(c.experiment), html_text(c.case_name),
                           to_text(c.status), html_text(c.reason));
  return items.empty() ? "" : "<h2>Cases without a time</h2>\n<ul>\n" + items + "</ul>\n";
}

std::string claims_html(const std::vector<claims::Judged>& judged) {
  if (judged.empty()) return {};
  std::string html =
      "<h2>Claims of the papers</h2>\n<p class=\"soft\">In our words, tested by these rows; <a "
      "href=\"tables/claims.csv\">CSV</a>.</p>\n<ul>\n";
  for (const claims::Judged& one : judged) {
    html +=
        fmt::format("<li><b>{}</b>: {} ({}, {})<br><span class=\"soft\">", to_text(one.verdict),
                    html_text(one.claim.statement), html_text(one.claim.paper), html_text(one.claim.section));
    if (one.value)
      html += fmt::format("{}: {}; the claim: {}. ", html_text(claims::description_of(one.claim)),
                          html_text(claims::effect_text(one)), html_text(one.claim.relation));
    html += fmt::format("{}</span></li>\n", html_text(one.reason));
  }
  return html + "</ul>\n";
}

}  // namespace

std::string html_of(const Report& report, const std::filesystem::path& folder) {
  std::string body;
  std::size_t ok = 0;
  for (const Cell& c : report.cells) ok += c.status == Status::ok;
  body += "<h1>pelage: results</h1>\n";
  body += fmt::format(
      "<p class=\"lead\">{} cases, {} of them ok: their timed frame agreed with the double-precision "
      "reference. No other case has a time. <a href=\"provenance.txt\">Provenance</a>, "
      "<a href=\"references.bib\">references</a>, "
      "<a href=\"tables/all-phases.csv\">all phases as CSV</a>.</p>\n",
      report.cells.size(), ok);
  for (const std::string& note : report.notes)
    body += fmt::format("<p class=\"soft\">{}</p>\n", html_text(note));
  for (const Section& section : report.sections) {
    const Table& table = section.table;
    body += fmt::format(
        "<h2>{}</h2>\n<p class=\"soft\">{} &middot; <a href=\"tables/{}.csv\">CSV</a> &middot; "
        "<a href=\"tables/{}.tex\">LaTeX</a></p>\n",
        html_text(table.title), html_text(table.subtitle), table.stem, table.stem);
    body += html_of(table);
  }
  body += claims_html(report.claims);
  body += html_of(report.solvers);
  body += failures_html(report);
  for (const ReportPlot& plot : report.plots)
    body += fmt::format(
        "<h2>{}</h2>\n<figure class=\"plot\">{}<figcaption><a href=\"plots/{}.svg\">SVG</a> &middot; "
        "<a href=\"plots/{}.pdf\">PDF</a> &middot; <a href=\"plots/{}.csv\">data</a> &middot; "
        "<a href=\"plots/{}.py\">program</a></figcaption></figure>\n",
        html_text(plot.title), svg_of(folder / "plots" / (plot.stem + ".svg")), plot.stem, plot.stem,
        plot.stem, plot.stem);
  if (!report.pictures.empty()) {
    body += "<h2>Pictures of the timed frames</h2>\n<div class=\"grid\">\n";
    for (const ReportPicture& picture : report.pictures)
      body += fmt::format(
          "<figure><a href=\"images/{}\"><img src=\"images/{}\" alt=\"{}\" loading=\"lazy\"></a>"
          "<figcaption>{}</figcaption></figure>\n",
          picture.file, picture.file, html_text(picture.title), html_text(picture.title));
    body += "</div>\n";
  }
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>pelage: results</title>\n<style>{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
      kStyle, body);
}

}  // namespace pelage
