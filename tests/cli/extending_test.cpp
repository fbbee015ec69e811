// Runs the commands of docs/extending.md block by block, as a reader would.
#include <set>

#include "tests/cli/document.hpp"

namespace pelage::cli {
namespace {

/// Copies the files that the diff names from `source` to `changes`, and applies the diff to the copies. The
/// test fails if the text that a hunk of the diff replaces does not occur exactly once in its file.
void apply(const std::string& diff, const fs::path& source, const fs::path& changes) {
  fs::path file;
  std::string before, after;
  const auto replace = [&] {
    if (before.empty()) return;
    test::write_text(file, test::replaced(test::text_of(file), before, after));
    before = after = "";
  };
  for (const std::string& line : test::lines_of(diff)) {
    if (line.rfind("+++ b/", 0) == 0) {
      replace();
      file = changes / line.substr(6);
      fs::create_directories(file.parent_path());
      if (!fs::exists(file)) fs::copy_file(source / line.substr(6), file);
    } else if (line.rfind("@@", 0) == 0) {
      replace();
    } else if (line.rfind("--- ", 0) != 0) {
      if (line[0] != '+') before += line.substr(1) + "\n";
      if (line[0] != '-') after += line.substr(1) + "\n";
    }
  }
  replace();
}

TEST(Extending, EveryBlockOfTheDocumentWorks) {
  const Folder folder;
  const fs::path source = PELAGE_SOURCE_DIR, changes = folder.path / "changes";
  const auto blocks = blocks_of(source / "docs/extending.md");
  ASSERT_GE(blocks.size(), 16u);
  fs::path binary = PELAGE_BINARY;
  std::set<std::string> touched;  // existing files that the document changed since the last build
  int shells = 0, builds = 0;
  bool changed = false;
  for (const Block& block : blocks) {
    SCOPED_TRACE("docs/extending.md, line " + std::to_string(block.line));
    if (block.language == "sh") {
      if (changed) {
        const std::string build = "python3 '" + (source / "tests/cli/changed_build.py").string() + "' '" +
                                  source.string() + "' '" +
                                  fs::path(PELAGE_BINARY).lexically_normal().parent_path().string() + "' '" +
                                  changes.string() + "'";
        ASSERT_EQ(run_in(folder, build, binary), 0) << folder.read("stdout") << folder.read("stderr");
        EXPECT_LE(touched.size(), 2u);  // each example may change at most two existing files
        touched.clear();
        binary = changes / "pelage";
        changed = false;
        ++builds;
      }
      ++shells;
      EXPECT_EQ(run_in(folder, block.text, binary), 0) << folder.read("stdout") << folder.read("stderr");
    } else if (block.language == "diff") {
      apply(block.text, source, changes);
      for (std::size_t at = 0; (at = block.text.find("+++ b/", at)) != std::string::npos; ++at)
        touched.insert(block.text.substr(at, block.text.find('\n', at) - at));
      changed = true;
    } else {
      const std::size_t end = block.text.find('\n');
      const bool code = block.language == "cpp";
      ASSERT_EQ(block.text.rfind(code ? "// " : "# ", 0), 0u);
      const std::string name = block.text.substr(code ? 3 : 2, end - (code ? 3 : 2));
      if (code) {
        fs::create_directories((changes / name).parent_path());
        folder.write("changes/" + name, block.text);
        changed = true;
      } else {
        folder.write(name, block.language == "toml" ? block.text : block.text.substr(end + 1));
      }
    }
  }
  EXPECT_GE(shells, 7);
  EXPECT_EQ(builds, 3);  // a mapping, a system, a topology
  for (const char* made : {"resolved.toml", "sheep.png", "tetrahedron.ply", "tetrahedron.png"})
    EXPECT_TRUE(fs::exists(folder.path / made)) << made;
}

}  // namespace
}  // namespace pelage::cli
