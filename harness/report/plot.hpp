// Draws plots with small Python programs (matplotlib), which every report contains beside their data.
#pragma once
#include <filesystem>
#include <string>

namespace pelage {

/// Returns the path of the plot program plots/NAME.py. Throws InputError if it is not installed.
std::filesystem::path plot_program(const std::string& name);

/// Runs `program table stem.svg stem.pdf` with /usr/bin/python3, or else the python3 on PATH. Returns "" if
/// the program wrote the pictures, else one line with the reason.
std::string draw_plot(const std::filesystem::path& program, const std::filesystem::path& table,
                      const std::filesystem::path& stem);

}  // namespace pelage
