#include "harness/commands/drawn_table.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "harness/atomic_file.hpp"
#include "harness/error.hpp"
#include "harness/report/plot.hpp"

namespace pelage {

namespace fs = std::filesystem;

void check_table_path(const std::string& output, const std::string& what) {
  if (output == "-") return;
  const std::string ending = fs::path(output).extension().string();
  if (ending != ".csv" && ending != ".svg" && ending != ".pdf")
    throw InputError(
        fmt::format("{}: {} is a table; it is written as .csv, or drawn as .svg and .pdf", output, what));
  require_place(output);
}

void write_drawn_table(const std::string& output, const std::string& text) {
  if (output == "-") {
    fmt::print("{}", text);
    return;
  }
  const fs::path file = output, table = fs::path(file).replace_extension(".csv");
  write_text_atomically(table, text);
  if (file.extension() == ".csv") return;
  const std::string problem = draw_plot(plot_program("section"), table, fs::path(file).replace_extension());
  if (!problem.empty()) throw InputError(fmt::format("{}: {}", file.string(), problem));
}

}  // namespace pelage
