// Reads the code blocks of a Markdown document, and runs blocks of shell commands.
#pragma once
#include <string>
#include <vector>

#include "tests/cli/shell.hpp"

namespace pelage::cli {

/// A code block: the text between two lines that begin with ```.
struct Block {
  int line = 0;  ///< number of the line with the first ```
  std::string language, text;
};

inline std::vector<Block> blocks_of(const fs::path& document) {
  std::vector<Block> blocks;
  bool inside = false;
  int number = 0;
  for (const std::string& line : test::lines_of(test::text_of(document))) {
    ++number;
    if (line.rfind("```", 0) == 0) {
      if (!inside) blocks.push_back({number, line.substr(3), ""});
      inside = !inside;
    } else if (inside) {
      blocks.back().text += line + "\n";
    }
  }
  return blocks;
}

/// Runs the script in the folder. In the script, the command `pelage` runs `binary`. Returns the script's
/// exit status.
inline int run_in(const Folder& folder, const std::string& script, const fs::path& binary = PELAGE_BINARY) {
  folder.write("block.sh", "set -e\n" + script);
  return shell(folder, fmt::format("PELAGE_KERNELS='{}/kernels' PATH=\"{}:$PATH\" sh block.sh",
                                   PELAGE_SOURCE_DIR, binary.parent_path().string()));
}

}  // namespace pelage::cli
