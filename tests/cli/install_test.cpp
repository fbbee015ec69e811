// Installs pelage into a temporary folder, and builds the Debian package. The installed program must use the
// installed files, not the files of the source tree.
#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

const std::string build = fs::path(PELAGE_BINARY).lexically_normal().parent_path().string();

std::string output_of(const Folder& folder, const std::string& script, int code = 0) {
  folder.write("script.sh", "set -e\n" + script);
  EXPECT_EQ(shell(folder, "bash script.sh"), code) << folder.read("stderr") << folder.read("stdout");
  return folder.read("stdout") + folder.read("stderr");
}

/// Installs pelage into the folder `inst`. The tests change installed files and expect that the program uses
/// the changed files.
struct Install : ::testing::Test {
  static void SetUpTestSuite() {
    folder = new Folder;
    output_of(*folder, "cmake --install '" + build + "' --prefix inst");
  }
  static void TearDownTestSuite() { delete folder; }
  static std::string installed(const std::string& arguments, int code = 0) {
    return output_of(*folder, "inst/bin/pelage " + arguments, code);
  }
  static Folder* folder;
};
Folder* Install::folder = nullptr;

TEST_F(Install, ExperimentsAndModelsAreTheInstalledOnes) {
  expect_has(installed("list"), "silva2010-table1");
  folder->write("inst/share/pelage/experiments/mine.toml",
                "name = \"mine\"\n[axes]\nmodel = [\"torus\"]\n[preset.quick]\n");
  expect_has(installed("list"), "mine\n");
  const std::string models = folder->read("inst/share/pelage/experiments/models.toml");
  folder->write("inst/share/pelage/experiments/models.toml", models + "\n[[model]]\nname = \"\"\n");
  expect_has(installed("mesh torus", 2), "inst/share/pelage/experiments/models.toml");
  folder->write("inst/share/pelage/experiments/models.toml", models);
  expect_has(installed("mesh torus"), "faces 9360");
}

TEST_F(Install, PicturesNeedTheInstalledKernelsAndTheImageModule) {
  const std::string render =
      "render --model torus --mapping pixel --size 48x32 --set fur.layers=4 --set fur.texture=32 ";
  installed(render + "-o a.exr");
  EXPECT_GT(fs::file_size(folder->path / "a.exr"), 100u);
  const std::string kernel = "inst/share/pelage/kernels/rasterize/pixel/pixel.cl",
                    text = folder->read(kernel);
  ASSERT_FALSE(text.empty());
  folder->write(kernel, "this is no kernel\n");
  installed(render + "-o b.png", 1);
  folder->write(kernel, text);
  fs::rename(folder->path / "inst/share/pelage/shaders", folder->path / "inst/share/pelage/away");
  expect_has(output_of(*folder, "inst/bin/pelage " + render + "--pipeline opengl -o c.png || true"),
             "inst/share/pelage");
  fs::rename(folder->path / "inst/share/pelage/away", folder->path / "inst/share/pelage/shaders");
}

TEST_F(Install, ReportsDrawWithTheInstalledPrograms) {
  const std::string recorded = "'" PELAGE_SOURCE_DIR "/results/silva2010-table1'";
  output_of(*folder, "for f in inst/share/pelage/plots/*.py; do echo '# installed' >> $f; done");
  installed("report " + recorded + " -o page");
  EXPECT_TRUE(fs::exists(folder->path / "page/index.html"));
  expect_has(output_of(*folder, "grep -rl '# installed' page"), ".py");
}

TEST_F(Install, TheManualAndTheDocumentsAreThere) {
  for (const char* file :
       {"share/man/man1/pelage.1", "share/doc/pelage/README.md", "share/doc/pelage/docs/results.md",
        "lib/python3/dist-packages/pelage/__init__.py", "share/pelage/examples/wet.toml"})
    EXPECT_TRUE(fs::exists(folder->path / "inst" / file)) << file;
}

TEST(Package, HoldsARunningProgramAndItsDependencies) {
  if (std::system("command -v dpkg-shlibdeps >/dev/null") != 0)
    GTEST_SKIP() << "cpack -G DEB needs dpkg-shlibdeps (Debian's package dpkg-dev)";
  const Folder folder;
  output_of(folder, "cpack -G DEB --config '" + build + "/CPackConfig.cmake' -B .\nmv *.deb pelage.deb");
  const std::string fields = output_of(folder, "dpkg-deb -f pelage.deb");
  expect_has(fields,
             {"Package: pelage", "libopenimageio", "ocl-icd-libopencl1", "libc6", "Section: science"});
  output_of(
      folder,
      "dpkg-deb -x pelage.deb .\ntest -f usr/lib/pelage/pelage_image_module.so || test -f usr/lib/*/pelage/pelage_image_module.so");
  expect_has(output_of(folder, "usr/bin/pelage list"), "silva2010-table1");
  output_of(
      folder,
      "usr/bin/pelage render --model torus --size 32x24 --set fur.layers=4 --set fur.texture=32 -o a.exr");
  if (std::system("/usr/bin/python3 -c 'import pandas' 2>/dev/null") == 0)
    expect_has(
        output_of(
            folder,
            "PYTHONPATH=usr/lib/python3/dist-packages /usr/bin/python3 -c 'import pelage; print(pelage.read(\"" PELAGE_SOURCE_DIR
            "/results/silva2010-table1\").shape)'"),
        "(192, ");
}

}  // namespace
}  // namespace pelage::cli
