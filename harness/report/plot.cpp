#include "harness/report/plot.hpp"

#include <fmt/format.h>

#include "harness/data_folder.hpp"
#include "harness/error.hpp"
#include "harness/isolated/isolated.hpp"

namespace pelage {

namespace fs = std::filesystem;

fs::path plot_program(const std::string& name) {
  for (const fs::path& data : data_folders(PELAGE_SOURCE_DIR, PELAGE_SHARE_DIR))
    // The first folder is that of an installation, and the second folder is that of the source tree.
    for (const char* folder : {"plots", "harness/report/plots"})
      if (const fs::path file = data / folder / (name + ".py"); fs::is_regular_file(file)) return file;
  throw InputError(fmt::format("plots/{}.py is missing; set PELAGE_DATA to pelage's data folder", name));
}

std::string draw_plot(const fs::path& program, const fs::path& table, const fs::path& stem) {
  const std::string python = fs::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
  const ProgramOutcome outcome = run_program(
      {python, "-B", program.string(), table.string(), stem.string() + ".svg", stem.string() + ".pdf"});
  if (outcome.code == 0) return {};
  if (outcome.code == 127) return "no plots: python3 is not installed";
  if (outcome.messages.find("No module named 'matplotlib'") != std::string::npos)
    return "no plots: matplotlib is not installed (Debian: python3-matplotlib)";
  return fmt::format("no plots: {}: {}", program.filename().string(), last_line(outcome.messages));
}

}  // namespace pelage
