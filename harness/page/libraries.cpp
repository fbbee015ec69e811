#include "harness/page/libraries.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

#include "harness/data_folder.hpp"
#include "harness/error.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view chart_file = "chart.min.js";

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Returns the text of the comment at the start of the script, for example "Chart.js v3.9.1 ...".
std::string banner_of(const std::string& script) {
  const std::size_t start = script.find("/*"), end = script.find("*/");
  if (start != 0 || end == std::string::npos) return {};
  std::string text;
  for (const char c : script.substr(start + 2, end - start - 2))
    if (c != '*' && c != '!' && !(c == ' ' && (text.empty() || text.back() == ' ' || text.back() == '\n')) &&
        !(c == '\n' && (text.empty() || text.back() == '\n')))
      text += c;
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

/// Returns the version number in the banner, which follows the first " v".
std::string version_of(const std::string& banner) {
  const std::size_t start = banner.find(" v");
  if (start == std::string::npos) return "unknown";
  return banner.substr(start + 2, banner.find_first_of(" \n", start + 2) - start - 2);
}

std::vector<fs::path> folders_of(const fs::path& folder) {
  if (!folder.empty()) return {folder};
  if (const char* own = std::getenv("PELAGE_JAVASCRIPT"); own != nullptr && *own != '\0') return {own};
  return {"/usr/share/javascript/chart.js", "/usr/share/nodejs/chart.js/dist"};
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

}  // namespace

std::optional<Library> chart_library(const fs::path& folder) {
  for (const fs::path& place : folders_of(folder)) {
    std::string text = text_of(place / chart_file);
    if (text.empty()) continue;
    std::string banner = banner_of(text);
    std::string licence = text_of("/usr/share/doc/libjs-chart.js/copyright");
    return Library{"Chart.js", version_of(banner), std::move(banner), std::move(licence), std::move(text)};
  }
  return {};
}

std::string web_file(const std::string& name) {
  for (const fs::path& data : data_folders(PELAGE_SOURCE_DIR, PELAGE_SHARE_DIR))
    // An installation has the folder "page"; the source tree has the folder "harness/page/web".
    for (const char* folder : {"page", "harness/page/web"})
      if (const fs::path file = data / folder / name; fs::is_regular_file(file)) return text_of(file);
  throw InputError(fmt::format("page/{} is missing; set PELAGE_DATA to pelage's data folder", name));
}

std::string script_text(std::string text) {
  replace_all(text, "</script", "<\\/script");
  replace_all(text, "</SCRIPT", "<\\/SCRIPT");
  replace_all(text, "<!--", "<\\!--");
  return text;
}

}  // namespace pelage
