// Tests commands on the results of a user's own experiment. The tests check which changes --resume refuses,
// how reports separate measurements of different inputs, and where pelage can write results.
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

std::string experiment_of(const std::string& length) {
  return "name = \"own\"\n[axes]\nmodel = [\"torus-24x12\"]\nlayers = [4, 8]\nsize = "
         "[\"320x240\"]\n[scene]\nfur.length = " +
         length +
         "\nfur.texture = 64\n[preset.quick]\nwarm_up_s = 0.0\nleast = 2\nmost = 2\nprecision = 1.0\nlimit_s "
         "= 20.0\n";
}

struct Results : ::testing::Test {
  void SetUp() override {
    folder.write("own.toml", experiment_of("0.1"));
    const Outcome first = pelage(folder, "run own.toml -o first");
    ASSERT_EQ(first.code, 0) << first.err;
  }
  Outcome resume(const std::string& options = "") {
    return pelage(folder, options + " run own.toml --resume first");
  }
  Folder folder;
};

TEST_F(Results, ResumeKeepsRowsOfEqualInputs) {
  const Outcome again = resume();
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.err.find("2 kept"), std::string::npos) << again.err;
}

TEST_F(Results, ResumeRefusesAnEditedScene) {
  folder.write("own.toml", experiment_of("0.12"));
  const Outcome edited = resume();
  EXPECT_EQ(edited.code, 2);
  EXPECT_NE(edited.err.find("measured something else: scene was "), std::string::npos) << edited.err;
  EXPECT_EQ(std::count(edited.err.begin(), edited.err.end(), '\n'), 1) << edited.err;
  folder.write("own.toml", experiment_of("0.1"));
  EXPECT_EQ(resume().code, 0);
}

// A row records a hash of the scene file's content, so --resume detects that the file was edited.
TEST_F(Results, ResumeRefusesAnEditedSceneFile) {
  std::string text = experiment_of("0.1");
  text.replace(text.find("fur.length = 0.1"), 16, "file = \"my.toml\"");
  folder.write("own.toml", text);
  folder.write("my.toml", "[fur]\nlength = 0.1\n");
  EXPECT_EQ(resume().code, 0) << "the scene is the same as before";
  folder.write("my.toml", "# edited\n[fur]\nlength = 0.10\n");
  EXPECT_EQ(resume().code, 0) << "a comment changes no key";
  folder.write("my.toml", "[fur]\nlength = 0.12\n");
  const Outcome edited = resume();
  EXPECT_EQ(edited.code, 2);
  EXPECT_NE(edited.err.find("measured something else: scene was "), std::string::npos) << edited.err;
}

// Without random droplets, no other key of the wetness changes a pixel.
TEST_F(Results, EqualPicturesAreNamedByRunAndReport) {
  std::string text = experiment_of("0.1");
  text.replace(text.find("layers = [4, 8]"), 15, "layers = [4]\nstate = [\"dry\", \"soaked\", \"long\"]");
  folder.write("own.toml",
               text + "[state.soaked]\nwetness.wetness = 0.8\n[state.long]\ncurl.radius = 0.02\n");
  const Outcome run = pelage(folder, "run own.toml -o wet");
  const std::string sentence = "The settings in which these cases differ change no pixel.";
  EXPECT_NE(run.err.find("pelage: own: Equal pictures: (torus_24x12-4-"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find(sentence), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("(torus_24x12-4-long"), std::string::npos) << run.err;
  const Outcome report = pelage(folder, "report wet -o page");
  EXPECT_NE(
      report.out.find("Equal pictures: (torus-24x12, dry, 4 layers, 320x240) and (torus-24x12, soaked, 4 "
                      "layers, 320x240). " +
                      sentence),
      std::string::npos)
      << report.out;
}

// The rows say what was measured, without the experiment file.
TEST_F(Results, RowsAndReportsContainTheSceneKeys) {
  std::string text = experiment_of("0.1");
  text.replace(text.find("layers = [4, 8]"), 15, "layers = [4]\nstate = [\"dry\", \"soaked\"]");
  folder.write("own.toml", text + "[state.soaked]\nwetness.random = 40\nwetness.wetness = 0.8\n");
  ASSERT_EQ(pelage(folder, "run own.toml -o wet").code, 0);
  std::filesystem::remove(folder.path() / "own.toml");
  ASSERT_EQ(pelage(folder, "report wet -o page").code, 0);
  const std::string provenance = folder.read("page/provenance.txt");
  EXPECT_NE(provenance.find("    fur.texture = 64\n"), std::string::npos) << provenance;
  EXPECT_NE(provenance.find("case torus_24x12-4-dry-320x240: no other keys\n"), std::string::npos)
      << provenance;
  EXPECT_NE(
      provenance.find("case torus_24x12-4-soaked-320x240: wetness.random = 40; wetness.wetness = 0.8\n"),
      std::string::npos)
      << provenance;
  EXPECT_NE(folder.read("page/index.html").find("wetness.random = 40; wetness.wetness = 0.8"),
            std::string::npos);
}

// A wrong name in [report] is reported before the run, and a report can use the corrected file.
TEST_F(Results, AMisspeltColumnIsNamedBeforeTheRunAndMendedAfterIt) {
  folder.write("own.toml", experiment_of("0.1") + "[report]\ny = \"medan_ms\"\n");
  const std::string warning =
      "own.toml: report.y names the column medan_ms, which is neither an axis nor a time of the table; did "
      "you mean "
      "median_ms?\n";
  EXPECT_NE(pelage(folder, "run own.toml --dry-run").err.find(warning), std::string::npos);
  const Outcome run = pelage(folder, "run own.toml -o second");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find(warning), std::string::npos) << run.err;
  const Outcome wrong = pelage(folder, "report second -o page");
  EXPECT_NE(
      wrong.err.find("(did you mean median_ms?); correct the table [report] of the experiment file and give "
                     "the file with --view"),
      std::string::npos)
      << wrong.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "page/plots/own-frame-time.json"));
  folder.write("own.toml", experiment_of("0.1") + "[report]\ny = \"median_ms\"\n");
  const Outcome mended = pelage(folder, "report second -o page --view own.toml");
  EXPECT_EQ(mended.code, 0) << mended.err;
  EXPECT_EQ(mended.err.find("no such column"), std::string::npos) << mended.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "page/plots/own-frame-time.json"));
  const Outcome other = pelage(folder, "report second -o page --view layers");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("--view layers: no row belongs to the experiment layers"), std::string::npos)
      << other.err;
}

TEST_F(Results, AnExperimentMayNameAnExampleScene) {
  std::string text = experiment_of("0.1");
  text.replace(text.find("fur.length"), 0, "file = \"wet-curls\"\n");
  folder.write("own.toml", text);
  const Outcome plan = pelage(folder, "run own.toml --dry-run");
  EXPECT_EQ(plan.code, 0) << plan.err;
  text.replace(text.find("wet-curls"), 9, "wet-curlz");
  folder.write("own.toml", text);
  const Outcome missing = pelage(folder, "run own.toml --dry-run");
  EXPECT_EQ(missing.code, 2);
  EXPECT_NE(missing.err.find("wet-curlz: there is no such scene file, and no such example in"),
            std::string::npos)
      << missing.err;
}

TEST_F(Results, AnExperimentIsNoScene) {
  const Outcome render = pelage(folder, "render own.toml -o x.png");
  EXPECT_EQ(render.code, 2);
  EXPECT_EQ(render.err,
            "pelage: own.toml:2: [axes] is a table of an experiment file, not of a scene; `pelage run "
            "own.toml` runs "
            "an experiment\n");
}

TEST_F(Results, ATooSmallPictureIsExplained) {
  const Outcome small = pelage(folder, "run own.toml --axis size=64x48 -o small");
  EXPECT_EQ(small.code, 1);
  EXPECT_NE(small.err.find(
                "windows against reference is 12, but must be at least 64: the picture is too small, or fur "
                "covers too few of its pixels"),
            std::string::npos)
      << small.err;
}

TEST_F(Results, LinkLoopsAndLongNamesAreBadInput) {
  std::filesystem::create_symlink("loop.toml", folder.path() / "loop.toml");
  const std::string longest(5000, 'a');
  for (const std::string& name : {std::string("loop.toml"), longest, longest + ".toml"})
    for (const std::string& command :
         {"scene " + name, "run " + name, "list " + name, "mesh " + name, "report first -o " + name,
          "export " + name, "run own.toml -o " + name, "run own.toml --tuning " + name, "profile -o " + name,
          "topology torus --draw " + name}) {
      const Outcome outcome = pelage(folder, command);
      EXPECT_EQ(outcome.code, 2) << command.substr(0, 60) << outcome.err;
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
  EXPECT_EQ(pelage(folder, "profile own.toml -o /proc/none --frames 1").code, 2);
}

TEST_F(Results, ResumeRefusesOtherLimitsOfSampling) {
  std::string text = experiment_of("0.1");
  text.replace(text.find("most = 2"), 8, "most = 3");
  folder.write("own.toml", text);
  const Outcome edited = resume();
  EXPECT_EQ(edited.code, 2);
  EXPECT_NE(edited.err.find("sampling was "), std::string::npos) << edited.err;
}

// --resume accepts a change to a kernel file that no measurement used.
TEST_F(Results, ResumeRefusesAnEditedKernelOnlyIfItRan) {
  namespace fs = std::filesystem;
  fs::copy(PELAGE_SOURCE_DIR "/kernels", folder.path() / "mine", fs::copy_options::recursive);
  EXPECT_EQ(resume("--kernels mine").code, 0);
  folder.write("mine/springs/gradients.cl", folder.read("mine/springs/gradients.cl") + "// edited\n");
  EXPECT_EQ(resume("--kernels mine").code, 0);
  folder.write("mine/dialect.clh", folder.read("mine/dialect.clh") + "// edited\n");
  const Outcome edited = resume("--kernels mine");
  EXPECT_EQ(edited.code, 2);
  EXPECT_NE(edited.err.find("kernel rasterize/"), std::string::npos) << edited.err;
}

TEST_F(Results, OtherInputsOfEqualNamesStandApart) {
  folder.write("own.toml", experiment_of("0.12"));
  ASSERT_EQ(pelage(folder, "run own.toml -o second").code, 0);
  const Outcome report = pelage(folder, "report first second -o page");
  EXPECT_EQ(report.code, 0) << report.err;
  EXPECT_NE(report.err.find("2 of 4 rows have the same names (case, variant, device and so on) as other rows "
                            "but measured different inputs (scene)"),
            std::string::npos)
      << report.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "page/inputs-2/tables/all-phases.csv"));
  EXPECT_EQ(pelage(folder, "compare first second").code, 0);
  EXPECT_EQ(pelage(folder, "compare first second --phase transform").code, 0);
  const Outcome phase = pelage(folder, "compare first second --phase bake");
  EXPECT_EQ(phase.code, 2);
  EXPECT_NE(phase.err.find("no row has times of the phase 'bake'; the phases are "), std::string::npos)
      << phase.err;
  std::filesystem::create_directory(folder.path() / "both");
  for (const char* one : {"first", "second"})
    std::filesystem::rename(folder.path() / one, folder.path() / "both" / one);
  const Outcome mixed = pelage(folder, "compare both both");
  EXPECT_EQ(mixed.code, 2);
  EXPECT_NE(mixed.err.find("different inputs (scene)"), std::string::npos) << mixed.err;
}

TEST_F(Results, ACopyCountsOnce) {
  std::filesystem::copy(folder.path() / "first", folder.path() / "copy",
                        std::filesystem::copy_options::recursive);
  const Outcome report = pelage(folder, "report first copy first -o page");
  EXPECT_EQ(report.code, 0) << report.err;
  EXPECT_NE(report.err.find("2 of 2 rows are in several journals"), std::string::npos) << report.err;
  const std::string lines = pelage(folder, "export first copy").out;
  EXPECT_EQ(lines, pelage(folder, "export first").out);
}

TEST_F(Results, CsvGoesToLinksPipesAndDevices) {
  namespace fs = std::filesystem;
  const std::string expected = pelage(folder, "export first").out;
  folder.write("real.csv", "old");
  fs::create_symlink("real.csv", folder.path() / "link.csv");
  EXPECT_EQ(pelage(folder, "export first --csv link.csv").code, 0);
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link.csv"));
  EXPECT_EQ(folder.read("real.csv"), expected);
  const Outcome full = pelage(folder, "export first --csv /dev/full");
  EXPECT_EQ(full.code, 2);
  EXPECT_NE(full.err.find("/dev/full: cannot be written"), std::string::npos) << full.err;
  EXPECT_FALSE(fs::is_regular_file("/dev/full"));
  ASSERT_EQ(std::system(("mkfifo '" + (folder.path() / "pipe").string() + "'").c_str()), 0);
  std::string piped;
  std::thread reader([&] { piped = folder.read("pipe"); });
  EXPECT_EQ(pelage(folder, "export first --csv pipe").code, 0);
  reader.join();
  EXPECT_EQ(piped, expected);
  fs::create_symlink("loop.csv", folder.path() / "loop.csv");
  EXPECT_EQ(pelage(folder, "export first --csv loop.csv").code, 2);
}

TEST_F(Results, AxesAreLimitedAndChecked) {
  const Outcome empty = pelage(folder, "run own.toml --dry-run --axis layers=");
  EXPECT_EQ(empty.code, 2);
  EXPECT_NE(empty.err.find("--axis 'layers=' has an empty value"), std::string::npos) << empty.err;
  const Outcome unknown = pelage(folder, "run own.toml --dry-run --axis zz=1");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("own: axis zz: zz: no such key"), std::string::npos) << unknown.err;
  const Outcome seed = pelage(folder, "run own.toml --dry-run --order-seed -1");
  EXPECT_EQ(seed.code, 2);
  EXPECT_NE(seed.err.find("the seed -1 is negative"), std::string::npos) << seed.err;
  const Outcome many = pelage(folder,
                              "run own.toml --dry-run --axis dynamics.wind.seed=$(seq -s, 1 1000) --axis "
                              "wetness.seed=$(seq -s, 1 1000)");
  EXPECT_EQ(many.code, 2);
  EXPECT_NE(many.err.find("2000000 combinations of values; the limit is 100000 cases"), std::string::npos)
      << many.err;
}

// /dev/full accepts no bytes, like a full disk.
TEST(FullDisk, ADumpEndsWithOneLine) {
  const Folder folder;
  std::filesystem::create_symlink("/dev/full", folder.path() / "full.h5");
  const Outcome full = pelage(folder,
                              "render -o a.png --pipeline reference --model torus-24x12 --size 16x16 --set "
                              "fur.layers=2 --dump full.h5");
  EXPECT_EQ(full.code, 2) << full.err;
  EXPECT_NE(full.err.find("cannot be written"), std::string::npos) << full.err;
  EXPECT_EQ(std::count(full.err.begin(), full.err.end(), '\n'), 1) << full.err;
}

// The file system has no room for a row (2100 KiB of 2 MiB are filled), or for a picture (2000 KiB).
TEST_F(Results, AFullDiskLeavesARunThatCanBeContinued) {
  const std::string inside = "mount -t tmpfs -o size=2m tmpfs full";
  std::filesystem::create_directory(folder.path() / "full");
  const std::string there = "cd '" + folder.path().string() + "' && unshare -Urm sh ";
  if (std::system((there + "-c '" + inside + "' 2>/dev/null").c_str()) != 0)
    GTEST_SKIP() << "this process may not mount a small file system";
  folder.write("own.toml", experiment_of("0.1"));
  const std::string program = "ASAN_OPTIONS=detect_leaks=0 '" PELAGE_BINARY "' run own.toml ";
  folder.write("script.sh", inside + "\nhead -c $1 /dev/zero >full/filler 2>/dev/null\n" + program +
                                "-o full/run 2>errors\necho $? >code\nrm full/filler\n" + program +
                                "--resume full/run 2>resumed\n");
  for (const auto& [filler, code] : {std::pair{"2100k", "2\n"}, {"2000k", "1\n"}}) {
    EXPECT_EQ(std::system((there + "script.sh " + filler + " >/dev/null").c_str()), 0)
        << folder.read("resumed");
    EXPECT_EQ(folder.read("code"), code) << folder.read("errors");
    EXPECT_NE(folder.read("errors").find("No space left on device"), std::string::npos)
        << folder.read("errors");
    EXPECT_NE(folder.read("resumed").find("2 cases ok, 0 cases not ok"), std::string::npos)
        << folder.read("resumed");
  }
}

// Nobody can create files in /proc, not even root.
TEST(Caches, WithoutAWritableCacheKernelsAreCompiledIntoATemporaryFolder) {
  const Folder folder;
  const Outcome outcome =
      pelage(folder, "render -o a.png --model torus-24x12 --size 16x16 --set fur.layers=2",
             "HOME=/proc XDG_CACHE_HOME=/proc/none POCL_CACHE_DIR= TMPDIR='" + folder.path().string() + "'");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("/proc/none/pocl/kcache cannot be written"), std::string::npos) << outcome.err;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().string().find("pelage-kernels"), std::string::npos) << entry.path();
}

TEST_F(Results, NumbersAreNamedAsTheyAreWritten) {
  std::string text = experiment_of("0.1");
  text.replace(text.find("layers = [4, 8]"), 15, "layers = [4]\ncurl.radius = [0.05, 0.1]");
  folder.write("own.toml", text);
  const Outcome dry = pelage(folder, "run own.toml --dry-run");
  EXPECT_EQ(dry.code, 0) << dry.err;
  EXPECT_NE(dry.out.find("torus_24x12-4-0.05-320x240\t"), std::string::npos) << dry.out;
}

TEST_F(Results, MeshFilesOfOneNameAreToldApartAndLongNamesRefused) {
  for (const std::string place : {"x", "y"}) {
    std::filesystem::create_directory(folder.path() / place);
    folder.write(place + "/m.obj", "a mesh; --dry-run does not read it");
  }
  std::string text = experiment_of("0.1");
  text.replace(text.find("[\"torus-24x12\"]"), 15, "[\"x/m.obj\", \"y/m.obj\"]");
  folder.write("own.toml", text);
  const Outcome dry = pelage(folder, "run own.toml --dry-run");
  EXPECT_EQ(dry.code, 0) << dry.err;
  EXPECT_NE(dry.out.find("\tx_m-4-320x240\t"), std::string::npos) << dry.out;
  EXPECT_NE(dry.out.find("\ty_m-8-320x240\t"), std::string::npos) << dry.out;
  const Outcome longer = pelage(folder, "run own.toml --dry-run --model " + std::string(240, 'm') + ".obj");
  EXPECT_EQ(longer.code, 2);
  EXPECT_NE(longer.err.find("the limit is 200"), std::string::npos) << longer.err;
}

TEST_F(Results, AKeyOfManyPartsIsRefused) {
  std::string key = "a";
  for (int i = 0; i < 50'000; ++i) key += ".a";
  folder.write("deep.toml", key + " = 1\n");
  folder.write("table.toml", "[" + key + "]\n");
  for (const char* command : {"scene deep.toml", "scene table.toml", "list deep.toml"}) {
    const Outcome deep = pelage(folder, command);
    EXPECT_EQ(deep.code, 2) << command;
    EXPECT_NE(deep.err.find(":1: the key has 50001 parts"), std::string::npos) << deep.err;
  }
}

}  // namespace
}  // namespace pelage::cli
