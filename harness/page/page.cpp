#include "harness/page/page.hpp"

#include <fmt/format.h>

#include <fstream>

#include "harness/atomic_file.hpp"
#include "harness/page/sha256.hpp"

namespace pelage {
namespace {

/// The page's own scripts, in the order in which they run.
constexpr const char* own_scripts[] = {"base.js", "tables.js", "rows.js", "charts.js", "gallery.js"};

/// Returns the source of the script for a Content-Security-Policy: 'sha256-...'.
std::string source_of(const std::string& script) {
  const auto digest = sha256(script);
  return fmt::format("'sha256-{}'", base64(std::string(digest.begin(), digest.end())));
}

}  // namespace

std::string page_of(const std::vector<Report>& reports, const PageParts& parts) {
  std::string sources, elements;
  const auto add_script = [&](const std::string& text) {
    const std::string script = script_text(text);
    sources += " " + source_of(script);
    elements += "<script>" + script + "</script>\n";
  };
  if (parts.charts) add_script(parts.charts->text);
  for (const char* name : own_scripts) add_script(web_file(name));

  std::string page = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += fmt::format(
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'; script-src{}; base-uri 'none'; form-action 'none'\">\n",
      sources);
  page +=
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>pelage: results</title>\n<style>\n";
  page += web_file("page.css") + "</style>\n</head>\n<body>\n";
  page += body_of(reports, parts);
  page += "<script type=\"application/json\" id=\"data\">" + data_of(reports) + "</script>\n";
  return page + elements + "</body>\n</html>\n";
}

std::vector<std::string> write_page(const std::vector<Report>& reports, const std::filesystem::path& file) {
  PageParts parts;
  parts.charts = chart_library();
  if (!parts.charts) parts.notes.emplace_back(no_chart_library);
  parts.pictures = page_pictures(reports, {}, parts.notes);
  const std::string page = page_of(reports, parts);
  write_atomically(file, [&](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << page << std::flush;
    if (!stream) throw InputError(fmt::format("{}: cannot be written", file.string()));
  });
  return parts.notes;
}

}  // namespace pelage
