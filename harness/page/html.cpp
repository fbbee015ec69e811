#include "harness/page/html.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/table/render.hpp"

namespace pelage {

void Body::heading(const std::string& title, int level, const std::string& detail) {
  const std::string id = fmt::format("s{}", entries_.size() + 1);
  html_ += fmt::format("<h{0} id=\"{1}\">{2}</h{0}>\n", level + 1, id, html_text(title));
  entries_.push_back({id, title, level, detail});
}

void Body::remark(const std::string& text) {
  if (!text.empty()) html_ += fmt::format("<p class=\"soft\">{}</p>\n", html_text(text));
}

void Body::save_button(const std::string& file, const std::string& label) {
  html_ += fmt::format("<button type=\"button\" class=\"scripted\" data-file=\"{}\">{}</button>\n",
                       html_text(file), html_text(label));
}

void Body::folded(const std::string& title, const std::string& text) {
  html_ += fmt::format("<details><summary>{}</summary><pre>{}</pre></details>\n", html_text(title),
                       html_text(text));
}

std::string contents_of(const std::vector<Entry>& entries) {
  std::string html = "<ul>\n";
  int level = 1;
  for (const Entry& entry : entries) {
    if (&entry != &entries.front()) html += entry.level > level ? "<ul>\n" : "</li>\n";
    if (entry.level < level) html += "</ul></li>\n";
    level = entry.level;
    const auto same = std::count_if(entries.begin(), entries.end(),
                                    [&](const Entry& other) { return other.title == entry.title; });
    std::string title = html_text(entry.title);
    if (same > 1 && !entry.detail.empty())
      title += fmt::format(" <span class=\"soft\">({})</span>", html_text(entry.detail));
    html += fmt::format("<li><a href=\"#{}\">{}</a>", entry.id, title);
  }
  if (!entries.empty()) html += "</li>\n";
  if (level > 1) html += "</ul></li>\n";
  return html + "</ul>\n";
}

}  // namespace pelage
