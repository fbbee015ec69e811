// Draws plots with small Python programs (matplotlib). Every report contains these programs beside their
// data.
#pragma once
#include <filesystem>
#include <string>

namespace pelage {

/// Returns the path of the plot program plots/NAME.py. Throws InputError if it is not installed.
std::filesystem::path plot_program(const std::string& name);

/// Runs `program table stem.svg stem.pdf` with /usr/bin/python3, or, if it does not exist, with the python3
/// on PATH. Returns "" if the program wrote the pictures, else one line with the reason: no Python, no
/// matplotlib, or the program's last error line.
std::string draw_plot(const std::filesystem::path& program, const std::filesystem::path& table,
                      const std::filesystem::path& stem);

}  // namespace pelage
