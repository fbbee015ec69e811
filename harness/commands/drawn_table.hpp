// Writes a CSV table to a file or to standard output, and draws it as a plot if the file is .svg or .pdf.
#pragma once
#include <string>

namespace pelage {

/// Throws InputError unless write_drawn_table() can write to `output`: "-", or a .csv, .svg or .pdf file in a
/// folder that exists. `what` names the table in the message.
void check_table_path(const std::string& output, const std::string& what);

/// Prints the CSV text if `output` is "-", and writes it otherwise. If `output` ends in .svg or .pdf, the
/// text is written beside it as .csv, and the program harness/report/plots/section.py draws it in both
/// formats. Throws InputError if the program cannot draw.
void write_drawn_table(const std::string& output, const std::string& text);

}  // namespace pelage
