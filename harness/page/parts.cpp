#include "harness/page/parts.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "harness/claims/print.hpp"

namespace pelage {
namespace {

/// Returns the part of a table's subtitle after "EXPERIMENT on DEVICE, ", or else the name of the experiment.
std::string detail_of(const std::string& subtitle) {
  const std::size_t comma = subtitle.find(", ");
  return comma == std::string::npos ? subtitle.substr(0, subtitle.find(" on ")) : subtitle.substr(comma + 2);
}

}  // namespace

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

void add_table(Body& body, const Table& table, bool latex) {
  body.heading(table.title, 2, detail_of(table.subtitle));
  body.remark(table.subtitle);
  if (!table.answer.empty()) body.add(fmt::format("<p class=\"answer\">{}</p>\n", html_text(table.answer)));
  body.add(html_of(table));
  std::vector<std::pair<std::string, std::string>> buttons{{table.stem + ".csv", "CSV"}};
  if (latex) buttons.emplace_back(table.stem + ".tex", "LaTeX");
  body.save_buttons(buttons);
}

namespace {

/// Returns links to the other claims with the same sentence, with their verdicts.
std::string same_sentence(const std::vector<claims::Judged>& judged, const claims::Judged& one) {
  std::string links;
  for (const claims::Judged& other : judged)
    if (other.claim.id != one.claim.id && other.claim.statement == one.claim.statement)
      links += fmt::format("{}<a href=\"#claim-{}\">{}</a> ({})", links.empty() ? "" : ", ",
                           html_text(other.claim.id), html_text(other.claim.id), to_text(other.verdict));
  return links.empty()
             ? ""
             : "<br><span class=\"soft\">The same sentence, tested otherwise: " + links + ".</span>";
}

/// Returns the names of the experiments whose rows decide.
std::string rows_of(const claims::Judged& one) {
  return one.claim.experiments.empty()
             ? ""
             : fmt::format("<br><span class=\"soft\">rows: {}</span>",
                           html_text(fmt::format("{}", fmt::join(one.claim.experiments, ", "))));
}

/// Says how the intervals of the claims differ from those of the tables, if they do.
std::string intervals_text(const std::vector<claims::Judged>& judged) {
  const int enough = claims::ClaimFile{}.separate_processes;
  for (const claims::Judged& one : judged)
    if (one.value && one.processes > 0 && one.processes < std::size_t(enough))
      return fmt::format(
          " Where fewer than {} processes measured a case, intervals assume that times vary by {:g}% between processes.",
          enough, 100 * one.claim.process_spread);
  return {};
}

}  // namespace

void add_claims(Body& body, const std::vector<claims::Judged>& judged, const char* title) {
  if (judged.empty()) return;
  body.heading(title, 2);
  body.remark("The claims are in our words." + intervals_text(judged));
  body.add(
      "<div class=\"wide\"><table class=\"claims\">\n<thead><tr><th>verdict</th><th>claim</th><th>measured</th><th>limit</th><th>source</th></tr></thead>\n<tbody>\n");
  for (const claims::Judged& one : judged) {
    std::string details = one.claim.test;
    if (!one.reason.empty())
      details += (details.empty() ? "" : " ") + fmt::format("Why {}: {}", to_text(one.verdict), one.reason);
    for (const std::string& note : one.notes)
      details += fmt::format("{}{}", details.empty() ? "" : details.ends_with('.') ? " " : ". ", note);
    body.add(fmt::format(
        "<tr id=\"claim-{7}\"><td><span class=\"verdict {0}\">{0}</span></td><td class=\"prose\">{1} <code>{7}</code>{2}{8}</td><td data-label=\"measured\" data-sort=\"{3}\">{4}</td><td data-label=\"limit\">{5}</td><td data-label=\"source\" class=\"prose\">{6}</td></tr>\n",
        to_text(one.verdict), html_text(one.claim.statement),
        details.empty() ? "" : fmt::format("<br><span class=\"soft\">{}</span>", html_text(details)),
        one.value ? fmt::format("{:.6g}", *one.value) : "",
        one.value ? fmt::format("{}<br><span class=\"soft\">{}</span>",
                                html_text(claims::effect_text(one) + claims::effects_text(one)),
                                html_text(claims::description_of(one.claim)))
                  : "-",
        one.value ? html_text(one.claim.relation) : "-",
        html_text(claims::source_of(one.claim)) + rows_of(one), html_text(one.claim.id),
        same_sentence(judged, one)));
  }
  body.add("</tbody></table></div>\n");
  body.save_buttons({{"claims.csv", "CSV"}});
}

}  // namespace pelage
