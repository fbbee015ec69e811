// Plots, drawn by small Python programs (matplotlib). Every report contains the programs beside their data.
#pragma once
#include <filesystem>
#include <string>

namespace pelage {

/// Returns pelage's plot program of that name (plots/NAME.py). Throws InputError if it is not installed.
std::filesystem::path plot_program(const std::string& name);

/// Runs `program table stem.svg stem.pdf` with Debian's python3, else with the python3 on PATH. Returns "" if
/// the program wrote the pictures, else one line with the reason (no Python, no matplotlib, ...); the report
/// then has no plots.
std::string draw_plot(const std::filesystem::path& program, const std::filesystem::path& table,
                      const std::filesystem::path& stem);

}  // namespace pelage
