// Plots, drawn by small Python programs (matplotlib) that stand beside their data in every report.
#pragma once
#include <filesystem>
#include <string>

namespace pelage {

/// The program of that name among pelage's own (plots/NAME.py). Throws InputError when it is not installed.
std::filesystem::path plot_program(const std::string& name);

/// Runs `program table stem.svg stem.pdf` with Debian's python3, else the one on PATH. Returns "" when the
/// pictures are there, else one line that says why not (no Python, no matplotlib, ...): a report goes without
/// plots then.
std::string draw_plot(const std::filesystem::path& program, const std::filesystem::path& table,
                      const std::filesystem::path& stem);

}  // namespace pelage
