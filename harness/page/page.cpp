#include "harness/page/page.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <random>

#include "harness/atomic_file.hpp"
#include "harness/data_folder.hpp"
#include "harness/error.hpp"

namespace pelage {
namespace {

/// pelage's own scripts in the page, in the order in which they run.
constexpr const char* own_scripts[] = {"base.js", "tables.js", "rows.js", "gallery.js"};

/// Returns the text of a script or style of the page, from harness/page/web or an installation's page/.
std::string web_file(const std::string& name) {
  for (const std::filesystem::path& data : data_folders(PELAGE_SOURCE_DIR, PELAGE_SHARE_DIR))
    for (const char* folder : {"page", "harness/page/web"}) {
      std::ifstream stream(data / folder / name, std::ios::binary);
      if (stream) return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    }
  throw InputError(fmt::format("page/{} is missing; set PELAGE_DATA to pelage's data folder", name));
}

/// Returns 128 random bits as hexadecimal digits, which a script hidden in the results cannot know.
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
  for (const char* name : own_scripts)
    elements += fmt::format("<script nonce=\"{}\">{}</script>\n", nonce, web_file(name));

  std::string page = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += fmt::format(
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'nonce-{}'; base-uri 'none'; form-action 'none'\">\n",
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
  parts.pictures = page_pictures(reports, {}, parts.notes);
  const std::string page = page_of(reports, parts);
  write_text_atomically(file, page);
  return parts.notes;
}

}  // namespace pelage
