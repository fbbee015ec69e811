#include "harness/page/page.hpp"

#include <fmt/format.h>

#include <random>

#include "harness/atomic_file.hpp"

namespace pelage {
namespace {

/// pelage's own scripts in the page, in the order in which they run.
constexpr const char* own_scripts[] = {"base.js", "tables.js", "rows.js", "charts.js", "gallery.js"};

/// Returns 128 random bits as hexadecimal digits. The page's Content-Security-Policy permits only scripts
/// whose attribute `nonce` is this number. Every page has a new random number, so a script hidden in the
/// results cannot know it.
std::string new_nonce() {
  std::random_device random;
  std::string text;
  for (int i = 0; i < 4; ++i) text += fmt::format("{:08x}", std::uint32_t(random()));
  return text;
}

}  // namespace

std::string page_of(const std::vector<Report>& reports, const PageParts& parts) {
  const std::string nonce = new_nonce();
  std::string elements;
  const auto add_script = [&](const std::string& text) {
    elements += fmt::format("<script nonce=\"{}\">{}</script>\n", nonce, script_text(text));
  };
  if (parts.charts) add_script(parts.charts->text);
  for (const char* name : own_scripts) add_script(web_file(name));

  std::string page = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += fmt::format(
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'; script-src 'nonce-{}'; base-uri 'none'; form-action 'none'\">\n",
      nonce);
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
  write_text_atomically(file, page);
  return parts.notes;
}

}  // namespace pelage
