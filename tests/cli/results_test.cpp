// Tests commands on the results of a user's own experiment. The tests check which changes --resume refuses,
// how reports separate measurements of different inputs, and where pelage can write results.
#include <thread>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

const std::string length = "fur.length = 0.1";

struct Results : InFolder {
  void SetUp() override {
    folder.write("own.toml", of_torus("layers = [4, 8]", length));
    done("run own.toml -o first");
  }
};

// A row records a hash of the scene file's content, so --resume detects that the file was edited.
TEST_F(Results, ResumeRefusesAnEditedSceneFile) {
  folder.write("own.toml", of_torus("layers = [4, 8]", "file = \"my.toml\""));
  folder.write("my.toml", "[fur]\nlength = 0.1\n");
  done("run own.toml --resume first");  // the scene is the same as before
  folder.write("my.toml", "# edited\n[fur]\nlength = 0.10\n");
  done("run own.toml --resume first");  // a comment changes no key
  folder.write("my.toml", "[fur]\nlength = 0.12\n");
  expect_refused(pelage("run own.toml --resume first"), "measured something else: scene was ");
}

// Without random droplets, no other key of the wetness changes a pixel.
TEST_F(Results, EqualPicturesAreNamedByRunAndReport) {
  folder.write("own.toml", of_torus("layers = [4]\nstate = [\"dry\", \"soaked\", \"long\"]", length) +
                               "[state.soaked]\nwetness.wetness = 0.8\n[state.long]\ncurl.radius = 0.02\n");
  const Outcome run = pelage("run own.toml -o wet");
  const std::string sentence = "The settings in which these cases differ change no pixel.";
  expect_has(run.err, {"pelage: own: Equal pictures: (torus_24x12-4-", sentence});
  expect_lacks(run.err, "(torus_24x12-4-long");
  expect_has(
      pelage("report wet -o page").out,
      "Equal pictures: (torus-24x12, dry, 4 layers, 320x240) and (torus-24x12, soaked, 4 layers, 320x240). " +
          sentence);
}

// The rows say what was measured, without the experiment file.
TEST_F(Results, RowsAndReportsContainTheSceneKeys) {
  folder.write("own.toml", of_torus("layers = [4]\nstate = [\"dry\", \"soaked\"]", length) +
                               "[state.soaked]\nwetness.random = 40\nwetness.wetness = 0.8\n");
  done("run own.toml -o wet");
  fs::remove(folder.path / "own.toml");
  done("report wet -o page");
  expect_has(folder.read("page/provenance.txt"),
             {"    fur.texture = 64\n", "case torus_24x12-4-dry-320x240: no other keys\n",
              "case torus_24x12-4-soaked-320x240: wetness.random = 40; wetness.wetness = 0.8\n"});
  expect_has(folder.read("page/index.html"), "wetness.random = 40; wetness.wetness = 0.8");
}

// A wrong name in [report] is reported before the run, and a report can use the corrected file.
TEST_F(Results, AMisspeltColumnIsNamedBeforeTheRunAndMendedAfterIt) {
  const std::string own = of_torus("layers = [4, 8]", length) + "[report]\n";
  folder.write("own.toml", own + "y = \"medan_ms\"\n");
  const std::string warning =
      "own.toml: report.y names the column medan_ms, which is neither an axis nor a time of the table; did you mean median_ms?\n";
  expect_has(pelage("run own.toml --dry-run").err, warning);
  expect_has(done("run own.toml -o second").err, warning);
  expect_has(
      pelage("report second -o page").err,
      "(did you mean median_ms?); correct the table [report] of the experiment file and give the file with --view");
  EXPECT_FALSE(fs::exists(folder.path / "page/plots/own-frame-time.json"));
  folder.write("own.toml", own + "y = \"median_ms\"\n");
  expect_lacks(done("report second -o page --view own.toml").err, "no such column");
  EXPECT_TRUE(fs::exists(folder.path / "page/plots/own-frame-time.json"));
  folder.write("view.toml", "name = \"own\"\n[report]\ny = \"fps\"\n");  // needs no axes
  expect_has(done("report second -o page2 --view view.toml").out, "own on");
  EXPECT_TRUE(fs::exists(folder.path / "page2/plots/own-fps.svg"));
  expect_refused(pelage("report second -o page --view layers"),
                 "--view layers: no row belongs to the experiment layers");
}

TEST_F(Results, AnExperimentMayNameAnExampleScene) {
  folder.write("own.toml", of_torus("layers = [4]", "file = \"wet-curls\""));
  done("run own.toml --dry-run");
  folder.write("own.toml", of_torus("layers = [4]", "file = \"wet-curlz\""));
  expect_refused(pelage("run own.toml --dry-run"),
                 "wet-curlz: there is no such scene file, and no such example in");
}

TEST_F(Results, AnExperimentIsNoScene) {
  expect_refused(
      pelage("render own.toml -o x.png"),
      "pelage: own.toml:2: [axes] is a table of an experiment file, not of a scene; `pelage run own.toml` runs an experiment");
}

TEST_F(Results, ATooSmallPictureIsExplained) {
  const Outcome small = pelage("run own.toml --axis size=64x48 -o small");
  EXPECT_EQ(small.code, 1);
  expect_has(
      small.err,
      "windows against reference is 12, but must be at least 64: the picture is too small, or fur covers too few of its pixels");
}

TEST_F(Results, LinkLoopsAndLongNamesAreBadInput) {
  fs::create_symlink("loop.toml", folder.path / "loop.toml");
  const std::string longest(5000, 'a');
  for (const std::string& name : {std::string("loop.toml"), longest, longest + ".toml"})
    for (const std::string& command :
         {"scene " + name, "run " + name, "list " + name, "mesh " + name, "report first -o " + name,
          "export " + name, "run own.toml -o " + name, "run own.toml --tuning " + name, "profile -o " + name,
          "topology torus --draw " + name})
      expect_refused(pelage(command), "");
  EXPECT_EQ(pelage("profile own.toml -o /proc/none --frames 1").code, 2);
}

TEST_F(Results, RowsOfDifferentInputsAreNotCompared) {
  folder.write("own.toml", of_torus("layers = [4, 8]", "fur.length = 0.12"));
  done("run own.toml -o second");
  done("compare first second");
  done("compare first second --phase transform");
  expect_refused(pelage("compare first second --phase bake"),
                 "no row has times of the phase 'bake'; the phases are ");
  fs::create_directory(folder.path / "both");
  for (const char* one : {"first", "second"}) fs::rename(folder.path / one, folder.path / "both" / one);
  expect_refused(pelage("compare both both"), "different inputs (scene)");
}

TEST_F(Results, AComparisonIsAlsoLatexAndAPlot) {
  folder.write("own.toml", of_torus("layers = [4, 8]", "fur.length = 0.12"));
  done("run own.toml -o second");
  const Outcome outcome = done("compare first second --latex table.tex --plot change.pdf");
  expect_has(outcome.out, {"Frame times of first and second", "first, ms", "layers=4", "verdict"});
  expect_has(folder.read("table.tex"), {"\\begin{tabular}{lrrrr}", "layers=8 &"});
  for (const char* file : {"change.pdf", "change.svg", "change.csv"})
    EXPECT_GT(fs::file_size(folder.path / file), 0u) << file;
  expect_refused(pelage("compare first second --plot change.png"),
                 "--plot change.png: the name must end in .svg or .pdf");
}

// Two numbers of threads of one device are one table with an axis, and not two sets of inputs.
TEST_F(Results, TwoNumbersOfThreadsAreAnAxis) {
  done("run own.toml -o one", "POCL_MAX_PTHREAD_COUNT=1");
  done("run own.toml -o two", "POCL_MAX_PTHREAD_COUNT=2");
  const Outcome report = done("report one two -o page");
  expect_has(report.out, "compute units");
  EXPECT_FALSE(fs::exists(folder.path / "page/inputs-2"));
  expect_has(folder.read("page/tables/own.csv"), ",compute_units,");
  expect_has(folder.read("page/tables/own.tex"), "compute units");
  fs::create_directory(folder.path / "both");
  for (const char* one : {"one", "two"}) fs::rename(folder.path / one, folder.path / "both" / one);
  expect_has(done("compare both --by axes.compute_units").out,
             {"compute_units=1, ms", "compute_units=2, ms"});
  expect_has(done("export both").out, "compute_units");
}

TEST_F(Results, AReportJudgesTheUsersClaims) {
  folder.write(
      "my.toml",
      "[[claim]]\nid = \"layers\"\nstatement = \"Eight layers take less than 100 times as long as four.\"\n"
      "rows = { experiment = \"own\" }\n"
      "effect = { name = \"ratio\", of = { layers = 8 }, to = { layers = 4 } }\nrelation = { below = 100 }\n");
  expect_has(done("report first -o page --claims my.toml").out, "Eight layers take less than 100 times");
  const std::string page = folder.read("page/index.html");
  expect_has(page, "Claims of my.toml");
  expect_has(page.substr(0, page.find("<nav")), "<b>holds:</b> Eight layers take less than 100 times");
  expect_refused(pelage("report first -o page --claims none.toml"), "none.toml");
}

TEST_F(Results, AnAxisThatNoPlotCanShowIsRefusedBeforeTheRun) {
  folder.write("own.toml", of_torus("layers = [4, 8]", length) + "[report]\nx = \"fur.layers\"\n");
  expect_refused(pelage("run own.toml -o x"),
                 "own.toml: report.x names fur.layers, which is no axis of the experiment (its axes: ");
  EXPECT_FALSE(fs::exists(folder.path / "x"));
}

TEST_F(Results, ACopyCountsOnce) {
  fs::copy(folder.path / "first", folder.path / "copy", fs::copy_options::recursive);
  expect_has(done("report first copy first -o page").err, "2 of 2 rows are in several journals");
  EXPECT_EQ(pelage("export first copy").out, pelage("export first").out);
}

TEST_F(Results, CsvGoesToLinksPipesAndDevices) {
  const std::string expected = pelage("export first").out;
  folder.write("real.csv", "old");
  fs::create_symlink("real.csv", folder.path / "link.csv");
  done("export first --csv link.csv");
  EXPECT_TRUE(fs::is_symlink(folder.path / "link.csv"));
  EXPECT_EQ(folder.read("real.csv"), expected);
  fs::create_directory(folder.path / "deep");
  fs::create_symlink("deep/link.csv", folder.path / "dangling.csv");
  fs::create_symlink("../new.csv", folder.path / "deep/link.csv");
  done("export first --csv dangling.csv");
  EXPECT_EQ(folder.read("new.csv"), expected);
  EXPECT_TRUE(fs::is_symlink(folder.path / "dangling.csv") && fs::is_symlink(folder.path / "deep/link.csv"));
  fs::create_symlink("round.csv", folder.path / "round.csv");
  expect_refused(pelage("export first --csv round.csv"), "round.csv: cannot be written");
  expect_refused(pelage("export first --csv /dev/full"), "/dev/full: cannot be written");
  EXPECT_FALSE(fs::is_regular_file("/dev/full"));
  ASSERT_EQ(shell("mkfifo pipe"), 0);
  std::string piped;
  std::thread reader([&] { piped = folder.read("pipe"); });
  EXPECT_EQ(pelage("export first --csv pipe").code, 0);
  reader.join();
  EXPECT_EQ(piped, expected);
  fs::create_symlink("loop.csv", folder.path / "loop.csv");
  EXPECT_EQ(pelage("export first --csv loop.csv").code, 2);
}

TEST_F(Results, AxesAreLimitedAndChecked) {
  const std::pair<const char*, const char*> refused[] = {
      {"--axis layers=", "--axis 'layers=' has an empty value"},
      {"--axis zz=1", "own: axis zz: zz: no such key"},
      {"--order-seed -1", "the seed -1 is negative"},
      {"--axis dynamics.wind.seed=$(seq -s, 1 1000) --axis wetness.seed=$(seq -s, 1 1000)",
       "2000000 combinations of values; the limit is 100000 cases"},
      {"--axis curl.turns=$(seq -s, 1 1000) --axis wetness.seed=$(seq -s, 1 50)",
       "each of the 100000 cases records the values of --set and --axis, 405 MB in total"},
      {"--model m$(printf '%0239d' 0).obj",
       "case m000000000000000000000000000000000000000... has 250 characters; the limit is 200"}};
  for (const auto& [options, message] : refused)
    expect_refused(pelage(std::string("run own.toml --dry-run ") + options), message);
}

// /dev/full accepts no bytes, like a full disk.
TEST(FullDisk, ADumpEndsWithOneLine) {
  const Folder folder;
  fs::create_symlink("/dev/full", folder.path / "full.h5");
  expect_refused(
      pelage(
          folder,
          "render -o a.png --pipeline reference --model torus-24x12 --size 16x16 --set fur.layers=2 --dump full.h5"),
      "cannot be written");
}

// The file system has no room for a row (2100 KiB of 2 MiB are filled), or for a picture (2000 KiB).
TEST_F(Results, AFullDiskLeavesARunThatCanBeContinued) {
  const std::string inside = "mount -t tmpfs -o size=2m tmpfs full";
  fs::create_directory(folder.path / "full");
  if (shell("unshare -Urm sh -c '" + inside + "'") != 0)
    GTEST_SKIP() << "this process may not mount a small file system";
  const std::string program = "'" PELAGE_BINARY "' run own.toml ";
  folder.write("script.sh", inside + "\nhead -c $1 /dev/zero >full/filler 2>/dev/null\n" + program +
                                "-o full/run 2>errors\necho $? >code\nrm full/filler\n" + program +
                                "--resume full/run 2>resumed\n");
  for (const auto& [filler, code] : {std::pair{"2100k", "2\n"}, {"2000k", "1\n"}}) {
    EXPECT_EQ(shell(std::string("unshare -Urm sh script.sh ") + filler), 0) << folder.read("resumed");
    EXPECT_EQ(folder.read("code"), code) << folder.read("errors");
    expect_has(folder.read("errors"), "No space left on device");
    expect_has(folder.read("resumed"), "2 cases ok, 0 cases not ok");
  }
}

// Nobody can create files in /proc, not even root.
TEST(Caches, WithoutAWritableCacheKernelsAreCompiledIntoATemporaryFolder) {
  const Folder folder;
  expect_has(
      done(folder, "render -o a.png --model torus-24x12 --size 16x16 --mapping pixel --set fur.layers=2",
           "HOME=/proc XDG_CACHE_HOME=/proc/none POCL_CACHE_DIR= TMPDIR='" + folder.path.string() + "'")
          .err,
      "/proc/none/pocl/kcache cannot be written");
  for (const auto& entry : fs::directory_iterator(folder.path))
    EXPECT_FALSE(has(entry.path().string(), "pelage-kernels")) << entry.path();
}

TEST_F(Results, MeshFilesOfOneNameAreToldApart) {
  for (const std::string place : {"x", "y"}) {
    fs::create_directory(folder.path / place);
    folder.write(place + "/m.obj", "a mesh; --dry-run does not read it");
  }
  folder.write("own.toml",
               experiment("model = [\"x/m.obj\", \"y/m.obj\"]\nlayers = [4, 8]\nsize = [\"320x240\"]"));
  expect_has(done("run own.toml --dry-run").out, {"\tx_m-4-320x240\t", "\ty_m-8-320x240\t"});
}

TEST_F(Results, AKeyOfManyPartsIsRefused) {
  std::string key = "a";
  for (int i = 0; i < 50'000; ++i) key += ".a";
  folder.write("deep.toml", key + " = 1\n");
  folder.write("table.toml", "[" + key + "]\n");
  for (const char* command : {"scene deep.toml", "scene table.toml", "list deep.toml"})
    expect_refused(pelage(command), ":1: the key has 50001 parts");
}

}  // namespace
}  // namespace pelage::cli
