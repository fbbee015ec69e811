#include "harness/page/papers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <set>

#include "harness/atomic_file.hpp"
#include "harness/error.hpp"
#include "harness/page/parts.hpp"
#include "harness/picture/image_io.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

std::vector<claims::Judged> claims_of(const PapersPage& page, const PaperPlan& plan) {
  std::vector<claims::Judged> found;
  for (const claims::Judged& one : page.claims)
    if (one.claim.paper == plan.paper) found.push_back(one);
  return found;
}

/// Returns a cell with the number of claims that have this verdict and, if `named`, their names, which lead
/// to the claims.
std::string verdict_cell(const std::vector<claims::Judged>& judged, claims::Verdict verdict, bool named) {
  std::size_t count = 0;
  std::string names;
  for (const claims::Judged& one : judged) {
    if (one.verdict != verdict) continue;
    ++count;
    names += fmt::format("{}<a href=\"#claim-{}\">{}</a>", names.empty() ? "" : ", ", html_text(one.claim.id),
                         html_text(one.claim.id));
  }
  return fmt::format("<td class=\"prose\" data-label=\"{}\">{}{}</td>", to_text(verdict), count,
                     named && count > 0 ? fmt::format("<br><small>{}</small>", names) : "");
}

/// Adds the table of the first screen: a line for each paper.
void add_summary(Body& body, const PapersPage& page) {
  body.add(fmt::format(
      "<div class=\"wide\"><table class=\"claims summary\">\n<thead><tr><th>paper</th>{}</tr></thead>\n<tbody>\n",
      page.smoke ? "<th>claims, not tested</th>"
                 : "<th>holds</th><th>fails</th><th>undecided</th><th>untestable</th>"));
  for (const PaperPart& part : page.papers) {
    const std::vector<claims::Judged> judged = claims_of(page, part.plan);
    body.add(fmt::format("<tr><td class=\"prose\"><a href=\"#{}\">{}</a></td>", part.plan.name,
                         html_text(part.plan.title)));
    if (page.smoke)
      body.add(fmt::format("<td data-label=\"claims, not tested\">{}</td></tr>\n", judged.size()));
    else
      body.add(verdict_cell(judged, claims::Verdict::holds, false) +
               verdict_cell(judged, claims::Verdict::fails, true) +
               verdict_cell(judged, claims::Verdict::undecided, true) +
               verdict_cell(judged, claims::Verdict::untestable, true) + "</tr>\n");
  }
  body.add("</tbody></table></div>\n");
}

void add_paper_claims(Body& body, const PapersPage& page, const PaperPlan& plan) {
  std::vector<claims::Judged> judged = claims_of(page, plan);
  if (page.smoke) {
    body.heading("Claims", 2);
    body.remark(fmt::format("{} claims are not tested with the preset smoke: it draws few small frames.",
                            judged.size()));
    body.add("<ul>\n");
    for (const claims::Judged& one : judged)
      body.add(fmt::format("<li>{}</li>\n", html_text(one.claim.statement)));
    body.add("</ul>\n");
    return;
  }
  // What fails comes first, then what could not be decided.
  const auto place = [](const claims::Judged& one) {
    static constexpr std::array<int, 4> order{2, 0, 1, 3};
    return order[std::size_t(one.verdict)];
  };
  std::ranges::stable_sort(judged, {}, place);
  add_claims(body, judged, "Claims");
}

/// Returns how many cells of the experiment's tables the preset smoke measured.
std::string measured_text(const std::vector<Report>& reports, const std::string& experiment) {
  std::size_t measured = 0, skipped = 0;
  for (const Report& report : reports)
    for (const Cell& cell : report.cells)
      if (cell.experiment == experiment) ++(cell.status == Status::skipped ? skipped : measured);
  return fmt::format(
      "The preset smoke measured {} cases of its own, most with smaller pictures or models. skipped: {} cases of the preset quick, which it did not measure.",
      measured, skipped);
}

void add_paper_table(Body& body, const std::vector<Report>& reports, const PaperTable& table, bool smoke) {
  body.heading(table.title, 2);
  body.remark(table.caption);
  bool any = false;
  for (std::size_t r = 0; r < reports.size(); ++r) {
    const Report& report = reports[r];
    body.add(fmt::format("<section data-part=\"{}\">\n", r));
    for (const Section& section : report.sections) {
      if (!section.table.subtitle.starts_with(table.experiment + " on ")) continue;
      any = true;
      body.remark(section.table.subtitle);
      if (!section.table.answer.empty())
        body.add(fmt::format("<p class=\"answer\">{}</p>\n", html_text(section.table.answer)));
      body.add(html_of(section.table));
      body.save_buttons({{section.table.stem + ".csv", "CSV"}, {section.table.stem + ".tex", "LaTeX"}});
      for (const PlotSpec& plot : section.plots)
        add_plot(body, report, {plot.title, plot.stem}, section.table.stem + ".csv");
    }
    body.add("</section>\n");
  }
  if (!any) body.remark("Not measured.");
  if (smoke && any) body.remark(measured_text(reports, table.experiment));
}

/// Adds a picture: SVG as text, other pictures as WebP.
void add_panel(Body& body, const FigurePanel& panel, const fs::path& file, const std::string& letter,
               int most_width) {
  const std::string label = (letter.empty() ? "" : fmt::format("({}) ", letter)) + html_text(panel.label);
  if (file.empty()) {
    body.add(fmt::format("<figure><figcaption>{}: not drawn</figcaption></figure>\n", label));
  } else if (file.extension() == ".svg") {
    std::ifstream stream(file, std::ios::binary);
    const std::string svg{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    const std::size_t start = svg.find("<svg ");
    if (start == std::string::npos) return;
    body.add(
        fmt::format("<figure><svg role=\"img\" aria-label=\"{}\" {}\n<figcaption>{}</figcaption></figure>\n",
                    label, svg.substr(start + 5), label));
  } else {
    const Picture picture = read_picture(file);
    const Picture small = picture.width > most_width ? reduced(picture, most_width) : picture;
    body.add(fmt::format(
        "<figure><img src=\"data:image/webp;base64,{}\" alt=\"{}\" width=\"{}\" height=\"{}\" loading=\"lazy\"><figcaption>{}</figcaption></figure>\n",
        base64(webp_of(small, 80)), label, small.width, small.height, label));
  }
}

void add_figure(Body& body, const PaperFigure& figure, const std::vector<fs::path>& files, int most_width) {
  body.heading(figure.title, 2);
  body.remark(figure.caption);
  const bool wide = files.size() == 1 || std::ranges::any_of(files, [](const fs::path& file) {
                      return file.extension() == ".svg";
                    });
  body.add(fmt::format("<div class=\"grid{}\">\n", wide ? " large" : ""));
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    add_panel(body, figure.panels[i], i < files.size() ? files[i] : fs::path(),
              figure.panels.size() > 1 ? std::string(1, char('a' + i)) : "", most_width);
  body.add(fmt::format("</div>\n<p class=\"differs\"><b>Against the paper's:</b> {}</p>\n",
                       html_text(figure.differs)));
}

void add_missing(Body& body, const PaperPlan& plan) {
  if (plan.missing.empty()) return;
  body.heading("What is missing", 2);
  body.add("<ul>\n");
  for (const MissingPart& part : plan.missing)
    body.add(fmt::format("<li>{}: {}</li>\n", html_text(part.what), html_text(part.why)));
  body.add("</ul>\n");
}

/// Explains the words that a reader of the papers does not know from them.
void add_terms(Body& body) {
  body.heading("Terms", 1);
  body.add("<dl>\n");
  for (
      const auto& [term, meaning] : {
          std::pair("pelage", "the program that measured this page: the papers' methods in OpenCL"),
          std::pair(
              "reading",
              "how the gaps of a paper's text are filled. \"paper\" is what the text prints, with the fewest repairs; \"pelage\" has our defaults"),
          std::pair("preset", "how much is measured: smoke, quick or paper"),
          std::pair(
              "case",
              "one combination of settings that is measured, such as a model, a number of layers and a size"),
          std::pair("ok", "the case's picture or state agreed with an implementation in double precision"),
          std::pair("control scene", "the scene with which a case is compared, frame by frame in turns"),
          std::pair(
              "OpenGL",
              "the papers' kind of program. On a device without a GPU, Mesa (llvmpipe) draws it on the same processor"),
          std::pair("R", "the unit of length: the radius of the model's bounding sphere"),
          std::pair(
              "effect",
              "the number that a claim is about; [a, b] is its 95% interval, or that with the confidence named behind it"),
          std::pair(
              "* and !",
              "a time that varies more than the preset allows; a time measured while other programs used the processor"),
          std::pair("geometric mean", "the mean of logarithms, for ratios"),
          std::pair("PSNR", "likeness of two pictures, in dB; equal pictures are called equal"),
      })
    body.add(fmt::format("<dt>{}</dt><dd>{}</dd>\n", html_text(term), html_text(meaning)));
  body.add("</dl>\n");
}

std::string devices_of(const std::vector<Report>& reports) {
  std::set<std::string> devices;
  for (const Report& report : reports)
    for (const FoundRow& found : report.rows) {
      const auto units = found.row.provenance.find("compute_units");
      const bool known = units != found.row.provenance.end() && units->is_number();
      devices.insert(found.row.device +
                     (known ? fmt::format(" with {} compute units", units->get<int>()) : ""));
    }
  std::string text;
  for (const std::string& device : devices) text += (text.empty() ? "" : ", ") + device;
  return text;
}

}  // namespace

std::string papers_body(const std::vector<Report>& reports, const PapersPage& page, int most_width) {
  Body body, summary;
  for (const PaperPart& part : page.papers) {
    body.add(fmt::format("<section data-part=\"0\" id=\"{}\">\n", html_text(part.plan.name)));
    body.heading(part.plan.title, 1);
    body.remark(part.plan.authors);
    add_paper_claims(body, page, part.plan);
    for (const PaperTable& table : part.plan.tables) add_paper_table(body, reports, table, page.smoke);
    if (!part.plan.figures_differ.empty()) {
      body.heading("How the figures differ", 2);
      body.remark(part.plan.figures_differ);
    }
    for (std::size_t f = 0; f < part.plan.figures.size(); ++f)
      add_figure(body, part.plan.figures[f],
                 f < part.panels.size() ? part.panels[f] : std::vector<fs::path>(), most_width);
    add_missing(body, part.plan);
    body.add("</section>\n");
  }
  add_terms(body);
  body.heading("Provenance", 1);
  for (const Report& report : reports) {
    body.folded("Runs, machines and programs", provenance_of(report.rows));
    body.folded("References (BibTeX)", bibliography_of(report.rows));
  }
  add_summary(summary, page);
  for (const std::string& note : page.notes) summary.remark(note);
  return fmt::format(
      "<header>\n<h1>{}</h1>\n<p class=\"lead\">{}</p>\n{}</header>\n"
      "<nav id=\"contents\" aria-label=\"Contents\"><details><summary>Contents</summary>\n{}</details></nav>\n"
      "<main>\n{}</main>\n",
      page.papers.size() == 1 ? html_text(page.papers.front().plan.title) : "Papers on real-time fur, rerun",
      html_text(fmt::format(
          "What the papers claim, and what the program pelage measured on {} (preset {}).{}",
          devices_of(reports), page.preset, page.smoke ? " The preset smoke tests no claim." : "")),
      summary.html(), contents_of(body.entries()), body.html());
}

void write_papers_page(const std::vector<Report>& reports, const PapersPage& page, const fs::path& file) {
  const std::string title = page.papers.size() == 1 ? "pelage: " + page.papers.front().plan.title
                                                    : "pelage: papers on real-time fur";
  std::vector<Report> shown = reports;
  if (page.smoke)
    for (Report& report : shown)
      std::erase_if(report.files, [](const auto& named) { return named.first == "claims.csv"; });
  write_text_atomically(file, html_page(title, papers_body(shown, page), shown));
}

}  // namespace pelage
