// PoCL keeps compiled kernels in a cache folder. The tests run commands with a damaged cache folder, and with
// a cache folder on a full disk.
#include <tuple>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

const std::string render =
    "render -o a.png --device pocl --model torus-24x12 --size 16x16 --set fur.layers=2";
const std::string shells = render + " --mapping pixel";  // compiles in the least time

struct KernelCache : InFolder {};

// If a program file in the cache (.bc) is empty, PoCL reports a missing kernel instead of a damaged file.
TEST_F(KernelCache, DamagedAndEmptyFilesLeadToTheAdviceToDeleteTheFolder) {
  const fs::path cache = folder.path / "kept";
  const std::string kept = "POCL_CACHE_DIR='" + cache.string() + "'";
  for (const auto& [ending, text, least] : {std::tuple{".so", "damaged", 4u}, {"/program.bc", "", 1u}}) {
    done(shells, kept);
    const std::vector<fs::path> files = test::files_below(cache, ending);
    ASSERT_GE(files.size(), least);
    for (const fs::path& file : files) test::write_text(file, text);
    const Outcome outcome = pelage(shells, kept);
    EXPECT_NE(outcome.code, 0);
    expect_has(outcome.err, "delete this folder and run the command again: " + cache.string());
    expect_lacks(outcome.err, "please report");
    fs::remove_all(cache);
  }
}

// PoCL reports each kernel that the process itself compiles.
TEST_F(KernelCache, OtherProcessesCompileAllKernelsOfAFirstPicture) {
  const std::string message = "Linking final module";
  const fs::path cache = folder.path / "kept";
  const std::string with = "POCL_DEBUG=all POCL_CACHE_DIR='" + cache.string() + "'";
  folder.write("few.toml", "pipeline = \"strands\"\n[[strands.layer]]\ncount = 50\n");
  expect_lacks(done(render + " few.toml", with).err, message);
  expect_lacks(done(render, with).err, message);
  const std::string picture = folder.read("a.png");
  const std::vector<fs::path> kernels = test::files_below(cache, ".so");
  ASSERT_FALSE(kernels.empty());
  for (const fs::path& kernel : kernels) fs::remove(kernel);
  expect_has(done(render, with).err, message);  // nothing starts a process twice for a program
  EXPECT_EQ(folder.read("a.png"), picture);
}

// The processes print nothing, so the command's message is the only one.
TEST_F(KernelCache, AProgramThatDoesNotBuildIsReportedByTheCommand) {
  fs::copy(fs::path(PELAGE_SOURCE_DIR) / "kernels", folder.path / "own", fs::copy_options::recursive);
  folder.write("own/simulate/simulate.cl", "this is no kernel\n");
  const Outcome outcome =
      pelage("--kernels 'own' " + shells, "POCL_CACHE_DIR='" + (folder.path / "kept").string() + "'");
  EXPECT_EQ(outcome.code, 1);
  expect_has(outcome.err, "simulate/simulate.cl does not build");
}

// PoCL aborts if POCL_CACHE_DIR is set but empty.
TEST_F(KernelCache, AnEmptyVariableIsNoFolder) {
  done("devices", "POCL_CACHE_DIR= XDG_CACHE_HOME='" + folder.path.string() + "'");
}

TEST_F(KernelCache, AFullDiskIsNamedAndReplacedByATemporaryFolder) {
  fs::create_directory(folder.path / "full");
  const std::string inside = "mount -t tmpfs -o size=64k tmpfs full";
  if (shell("unshare -Urm sh -c '" + inside + "'") != 0)
    GTEST_SKIP() << "this process may not mount a small file system";
  folder.write("script.sh",
               inside + "\nPOCL_CACHE_DIR=full/kept '" PELAGE_BINARY "' " + shells + " 2>errors\n");
  EXPECT_EQ(shell("unshare -Urm sh script.sh"), 0) << folder.read("errors");
  expect_has(folder.read("errors"), "KiB of free disk space; PoCL keeps compiled kernels in a temporary");
}

}  // namespace
}  // namespace pelage::cli
