// Reads the JavaScript library Chart.js, which is copied into the HTML report, and pelage's own scripts and
// styles.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace pelage {

/// An installed JavaScript library.
struct Library {
  std::string name;     ///< "Chart.js"
  std::string version;  ///< "3.9.1"
  std::string banner;   ///< first comment of the script: name, version, copyright, licence
  std::string licence;  ///< text of the installed licence file; "" if there is no such file
  std::string text;     ///< the script
};

/// Reads Chart.js, which draws the plots of the page, from `folder`. If `folder` is empty, searches the
/// folder that the environment variable PELAGE_JAVASCRIPT names. If this variable is not set, searches the
/// folders of Debian's package libjs-chart.js. Returns nothing if the searched folders do not contain
/// Chart.js.
std::optional<Library> chart_library(const std::filesystem::path& folder = {});

/// Note for the user if Chart.js is missing.
inline constexpr const char* no_chart_library =
    "the page's plots are static pictures: Chart.js is not installed (Debian: libjs-chart.js)";

/// Returns the text of one of pelage's web files. They are in harness/page/web, or in share/pelage/page of an
/// installation. Throws InputError if the file is missing.
std::string web_file(const std::string& name);

/// Returns the script with "</script" and "<!--" escaped, so that the text can be the content of a "script"
/// element.
std::string script_text(std::string text);

}  // namespace pelage
