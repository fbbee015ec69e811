// PoCL keeps compiled kernels in a cache folder. The tests run commands with a damaged cache folder, and with
// a cache folder on a full disk.
#include <gtest/gtest.h>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

namespace fs = std::filesystem;

const std::string render =
    "render -o a.png --device pocl --model torus-24x12 --size 16x16 --set fur.layers=2";

TEST(KernelCache, ADamagedFileLeadsToTheAdviceToDeleteTheFolder) {
  const Folder folder;
  const std::string kept = "POCL_CACHE_DIR='" + (folder.path() / "kept").string() + "'";
  ASSERT_EQ(pelage(folder, render, kept).code, 0) << folder.read("stderr");
  int damaged = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path() / "kept"))
    if (entry.path().extension() == ".so") {
      std::ofstream(entry.path()) << "damaged";
      ++damaged;
    }
  ASSERT_GT(damaged, 3);
  const Outcome outcome = pelage(folder, render, kept);
  EXPECT_NE(outcome.code, 0);
  EXPECT_NE(
      outcome.err.find("delete this folder and run the command again: " + (folder.path() / "kept").string()),
      std::string::npos)
      << outcome.err;
  fs::remove_all(folder.path() / "kept");
  EXPECT_EQ(pelage(folder, render, kept).code, 0) << folder.read("stderr");
}

// If a program file in the cache is empty, PoCL reports a missing kernel instead of a damaged file.
TEST(KernelCache, AnEmptyFileOfAProgramLeadsToTheSameAdvice) {
  const Folder folder;
  const std::string kept = "POCL_CACHE_DIR='" + (folder.path() / "kept").string() + "'";
  ASSERT_EQ(pelage(folder, render, kept).code, 0) << folder.read("stderr");
  int emptied = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path() / "kept"))
    if (entry.path().filename() == "program.bc") {
      fs::resize_file(entry.path(), 0);
      ++emptied;
    }
  ASSERT_GT(emptied, 0);
  const Outcome outcome = pelage(folder, render, kept);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(
      outcome.err.find("delete this folder and run the command again: " + (folder.path() / "kept").string()),
      std::string::npos)
      << outcome.err;
  EXPECT_EQ(outcome.err.find("please report"), std::string::npos) << outcome.err;
}

// PoCL aborts if POCL_CACHE_DIR is set but empty.
TEST(KernelCache, AnEmptyVariableIsNoFolder) {
  const Folder folder;
  const std::string cache = "XDG_CACHE_HOME='" + folder.path().string() + "'";
  const Outcome outcome = pelage(folder, "devices", "POCL_CACHE_DIR= " + cache);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST(KernelCache, AFullDiskIsNamedAndReplacedByATemporaryFolder) {
  const Folder folder;
  fs::create_directory(folder.path() / "full");
  const std::string inside = "mount -t tmpfs -o size=64k tmpfs full";
  if (std::system(("cd '" + folder.path().string() + "' && unshare -Urm sh -c '" + inside + "' 2>/dev/null")
                      .c_str()) != 0)
    GTEST_SKIP() << "this process may not mount a small file system";
  folder.write("script.sh",
               inside + "\nPOCL_CACHE_DIR=full/kept ASAN_OPTIONS=detect_leaks=0 '" PELAGE_BINARY "' " +
                   render + " 2>errors\n");
  EXPECT_EQ(std::system(("cd '" + folder.path().string() + "' && unshare -Urm sh script.sh").c_str()), 0)
      << folder.read("errors");
  EXPECT_NE(folder.read("errors").find("KiB of free disk space; PoCL keeps compiled kernels in a temporary"),
            std::string::npos)
      << folder.read("errors");
}

}  // namespace
}  // namespace pelage::cli
