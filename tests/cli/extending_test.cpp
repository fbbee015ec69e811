// Runs the commands of docs/extending.md block by block, as a reader would.
#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

struct Block {
  int line = 0;
  std::string language, text;
};

std::vector<Block> blocks_of(const std::filesystem::path& document) {
  std::ifstream file(document);
  std::vector<Block> blocks;
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
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

TEST(Extending, EveryBlockOfTheDocumentWorks) {
  const Folder folder;
  const std::filesystem::path source = PELAGE_SOURCE_DIR;
  const auto blocks = blocks_of(source / "docs/extending.md");
  ASSERT_GE(blocks.size(), 6u);
  int shells = 0;
  for (const Block& block : blocks) {
    if (block.language != "sh") {
      const std::string name = block.text.substr(2, block.text.find('\n') - 2);
      ASSERT_EQ(block.text.rfind("# ", 0), 0u) << "line " << block.line;
      const bool toml = block.language == "toml";
      folder.write(name, toml ? block.text : block.text.substr(block.text.find('\n') + 1));
      continue;
    }
    ++shells;
    folder.write("block.sh", "set -e\n" + block.text);
    const std::string command =
        "cd '" + folder.path().string() + "' && ASAN_OPTIONS=detect_leaks=0 PELAGE_KERNELS='" +
        (source / "kernels").string() +
        "' PATH=\"$(dirname '" PELAGE_BINARY "'):$PATH\" sh block.sh >stdout 2>stderr";
    EXPECT_EQ(std::system(command.c_str()), 0) << "line " << block.line << "\n"
                                               << folder.read("stdout") << folder.read("stderr");
  }
  EXPECT_GE(shells, 4);
  for (const char* made : {"resolved.toml", "sheep.png", "tetrahedron.ply", "tetrahedron.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / made)) << made;
  }
}

}  // namespace
}  // namespace pelage::cli
