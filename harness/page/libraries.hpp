// The JavaScript library that the page contains, and the page's own scripts and styles.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace pelage {

/// A library as it is installed. The page contains its text.
struct Library {
  std::string name;     ///< "Chart.js"
  std::string version;  ///< "3.9.1"
  std::string banner;   ///< first comment of the file: name, version, copyright and licence
  std::string licence;  ///< text of the licence as installed; "" if it is not installed
  std::string text;     ///< the script
};

/// Returns Chart.js, which draws the page's plots, from `folder`; no value if it is not there. If `folder` is
/// empty, searches $PELAGE_JAVASCRIPT if it is set, else the folders in which Debian's package libjs-chart.js
/// installs it.
std::optional<Library> chart_library(const std::filesystem::path& folder = {});

/// The note about a missing Chart.js.
inline constexpr const char* no_chart_library =
    "the page's plots are static pictures: Chart.js is not installed (Debian: libjs-chart.js)";

/// Returns the text of a file of harness/page/web, or of share/pelage/page in an installation. Throws
/// InputError if it is missing.
std::string web_file(const std::string& name);

/// Returns the text of a script as the content of an element "script": no "</script" and no "<!--" occurs.
std::string script_text(std::string text);

}  // namespace pelage
