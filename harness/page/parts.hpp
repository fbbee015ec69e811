// Parts of the HTML pages: headings with their table of contents, tables, plots and claims.
#pragma once
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/claims/judge.hpp"
#include "harness/report/report.hpp"
#include "harness/table/render.hpp"

namespace pelage {

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
std::string contents_of(const std::vector<Entry>& entries);

/// Returns the bytes as Base64 (RFC 4648), with padding.
std::string base64(std::string_view bytes);

/// Adds the SVG picture of the plot from the folder of the report, and a button that saves the plotted table.
void add_plot(Body& body, const Report& report, const ReportPlot& plot, const std::string& table);

/// Adds the table with its heading. `latex`: also a button that saves it as LaTeX.
void add_table(Body& body, const Table& table, bool latex);

/// Adds a table of claims and their verdicts, unless there are none.
void add_claims(Body& body, const std::vector<claims::Judged>& judged, const char* title);

/// Returns the text of the page: `body` is the HTML inside the "body" element, without the scripts.
std::string html_page(const std::string& title, const std::string& body, const std::vector<Report>& reports);

}  // namespace pelage
