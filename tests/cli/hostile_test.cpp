// Tests commands with harmful input. With these names, options and files, earlier versions of pelage crashed,
// hung, used gigabytes of memory or printed a wrong reason.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

namespace fs = std::filesystem;

std::string experiment(const std::string& models, const std::string& more = "layers = [4]") {
  return "name = \"own\"\n[axes]\nmodel = " + models + "\n" + more +
         "\nsize = [\"320x240\"]\n[scene]\nfur.texture = 64\n[preset.quick]\nwarm_up_s = 0.0\nleast = "
         "2\nmost = "
         "2\nprecision = 1.0\nlimit_s = 20.0\n";
}

void expect_one_line(const Outcome& outcome, int code, const std::string& expected) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(expected), std::string::npos) << outcome.err;
}

TEST(Hostile, APictureIsWrittenThroughALink) {
  const Folder folder;
  folder.write("real.png", "old");
  fs::create_symlink("real.png", folder.path() / "link.png");
  const Outcome drawn = pelage(
      folder, "render -o link.png --pipeline reference --model torus-24x12 --size 16x16 --set fur.layers=2");
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link.png"));
  EXPECT_EQ(folder.read("real.png").substr(1, 3), "PNG");
}

TEST(Hostile, FiltersOfEveryShapeEndWithOneShortLine) {
  const Folder folder;
  folder.write("own.toml", experiment("[\"torus-24x12\"]"));
  const std::string check = "check --filter '";
  const Outcome deep = pelage(folder, check + std::string(20'000, '(') + "'");
  expect_one_line(deep, 2, "this is not a valid regular expression");
  EXPECT_LT(deep.err.size(), 400u) << "the message must not repeat the expression";
  expect_one_line(pelage(folder, "run own.toml --dry-run --filter '(.*)*x(.*)*y(.*)*z$'"), 2,
                  "no case has a name that matches");
}

TEST(Hostile, ExperimentsOfTooManyCasesAreRefusedBeforeTheirListIsMade) {
  const Folder folder;
  std::string hundred = "[0";
  for (int i = 1; i < 100; ++i) hundred += ", " + std::to_string(i);
  hundred += "]\n";
  std::string axes = "layers = [4]\n";
  for (const char* key : {"dynamics.wind.seed", "wetness.seed", "fur.seed", "coat.seed", "curl.turns"})
    axes += key + (" = " + hundred);
  folder.write("own.toml", experiment("[\"torus-24x12\"]", axes));
  for (const char* command : {"list own.toml", "run own.toml --dry-run"})
    expect_one_line(pelage(folder, command), 2, "10000000000 combinations of values; the limit is 100000");
}

// Every case records the values of --axis, so the memory grows with the square of their number. pelage
// refuses the values that would need gigabytes. The values of an axis in an experiment file are not recorded.
TEST(Hostile, AnAxisOfManyValuesIsNoCaseOfManyGigabytes) {
  const Folder folder;
  folder.write("own.toml", experiment("[\"torus-24x12\"]"));
  expect_one_line(
      pelage(folder, "run own.toml --dry-run --axis wetness.seed=$(seq -s, 1 20000)"), 2,
      "each of the 20000 cases records the values of --set and --axis, 2178 MB in total; the limit "
      "is 256 MB");
  std::string values = "[1";
  for (int i = 2; i <= 20'000; ++i) values += ", " + std::to_string(i);
  folder.write("long.toml", experiment("[\"torus-24x12\"]", "layers = [4]\nwetness.seed = " + values + "]"));
  const Outcome dry = pelage(folder, "run long.toml --dry-run");
  EXPECT_EQ(dry.code, 0) << dry.err.substr(0, 300);
  EXPECT_EQ(std::count(dry.out.begin(), dry.out.end(), '\n'), 20'000);
  rusage use{};
  ASSERT_EQ(getrusage(RUSAGE_CHILDREN, &use), 0);
  EXPECT_LT(use.ru_maxrss, 1024L * 1024) << "KiB, the largest memory of a process of this test program";
}

TEST(Hostile, ACoatOfTooManyPixelsIsRefused) {
  const Folder folder;
  // A truncated PNG file: the header of a grey picture of 16384 x 16384 pixels, and the beginning of its
  // pixel data.
  folder.write(
      "coat.png",
      std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x40\0\0\0\x40\0\x08\0\0\0\0\x8c\xa3\x4f\x58", 33) +
          std::string("\0\x04\x93\xe0IDAT", 8) + std::string(300'000, '\0'));
  const Outcome refused = pelage(
      folder,
      "render -o a.png --pipeline reference --model torus-24x12 --size 16x16 --set coat.image=coat.png");
  EXPECT_EQ(refused.code, 2) << refused.err;
  EXPECT_NE(refused.err.find("16384 x 16384 pixels; pelage reads pictures of at most 67108864 pixels"),
            std::string::npos)
      << refused.err;
}

TEST(Hostile, ControlCharactersOfNamesDoNotReachTheTerminal) {
  const Folder folder;
  const Outcome outcome = pelage(folder, "render -o \"$(printf 'a\\033[31mb\\007.jpg')\"");
  expect_one_line(outcome, 2, "a\\x1b[31mb\\x07.jpg: a picture is written as .png, .exr or .tif");
}

TEST(Hostile, ABadLineOfAJournalNamesTheRemedyWhichWorks) {
  const Folder folder;
  folder.write("own.toml", experiment("[\"torus-24x12\"]", "layers = [4, 8]"));
  ASSERT_EQ(pelage(folder, "run own.toml -o out").code, 0) << folder.read("stderr");
  fs::path journal;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path() / "out"))
    if (entry.path().extension() == ".jsonl") journal = entry.path().lexically_relative(folder.path());
  const std::string good = folder.read(journal.string());
  folder.write(journal.string(), "damaged" + good);
  for (const char* command : {"run own.toml --resume out", "report out -o page"})
    expect_one_line(pelage(folder, command), 2, "if you delete this line, --resume runs its case again");
  folder.write(journal.string(), good.substr(good.find('\n') + 1));
  const Outcome resumed = pelage(folder, "run own.toml --resume out");
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_NE(resumed.err.find("1 cases ok"), std::string::npos) << resumed.err;
}

TEST(Hostile, ACaseThatEndsInAnErrorGivesCode1AndIsTriedAgain) {
  const Folder folder;
  folder.write("own.toml", experiment("[\"torus-24x12\", \"other.obj\"]"));
  folder.write("other.obj", "no mesh\n");
  for (const char* command : {"run own.toml -o out", "run own.toml --resume out"}) {
    const Outcome outcome = pelage(folder, command);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_NE(outcome.err.find("1 cases not ok"), std::string::npos) << outcome.err;
  }
}

// A user can interrupt pelage before it creates the results folder. pelage must then not advise the user to
// continue the run with --resume. It may end without any message.
TEST(Hostile, AnInterruptBeforeTheFirstRowAdvisesNoFolder) {
  const Folder folder;
  folder.write("own.toml", experiment("[\"torus-24x12\"]"));
  const std::string interrupted = "timeout -s INT ";
  for (const char* seconds : {"0.02", "0.05", "0.1", "0.2"}) {
    const Outcome outcome = pelage(folder, "run own.toml -o none", interrupted + seconds);
    if (fs::exists(folder.path() / "none")) break;
    EXPECT_EQ(outcome.err.find("--resume"), std::string::npos) << seconds << " s: " << outcome.err;
  }
}

}  // namespace
}  // namespace pelage::cli
