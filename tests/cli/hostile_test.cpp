// Tests commands with harmful input. With these names, options and files, earlier versions of pelage crashed,
// hung, used gigabytes of memory or printed a wrong reason.
#include <sys/resource.h>

#include <algorithm>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

struct Hostile : InFolder {};

TEST_F(Hostile, APictureIsWrittenThroughALink) {
  folder.write("real.png", "old");
  fs::create_symlink("real.png", folder.path / "link.png");
  done("render -o link.png --pipeline reference --model torus-24x12 --size 16x16 --set fur.layers=2");
  EXPECT_TRUE(fs::is_symlink(folder.path / "link.png"));
  EXPECT_EQ(folder.read("real.png").substr(1, 3), "PNG");
}

TEST_F(Hostile, FiltersOfEveryShapeEndWithOneShortLine) {
  folder.write("own.toml", of_torus("layers = [4]"));
  const std::string check = "check --filter '";
  const Outcome deep = pelage(check + std::string(20'000, '(') + "'");
  expect_refused(deep, "this is not a valid regular expression");
  EXPECT_LT(deep.err.size(), 400u) << "the message must not repeat the expression";
  expect_refused(pelage("run own.toml --dry-run --filter '(.*)*x(.*)*y(.*)*z$'"),
                 "no case of the preset quick has a name that matches");
}

TEST_F(Hostile, ExperimentsOfTooManyCasesAreRefusedBeforeTheirListIsMade) {
  std::string hundred = "[0";
  for (int i = 1; i < 100; ++i) hundred += ", " + std::to_string(i);
  hundred += "]\n";
  std::string axes = "layers = [4]\n";
  for (const char* key : {"dynamics.wind.seed", "wetness.seed", "fur.seed", "coat.seed", "curl.turns"})
    axes += key + (" = " + hundred);
  folder.write("own.toml", of_torus(axes));
  for (const char* command : {"list own.toml", "run own.toml --dry-run"})
    expect_refused(pelage(command), "10000000000 combinations of values; the limit is 100000");
}

// Every case records the values of --axis, so the memory grows with the square of their number. pelage
// refuses the values that would need gigabytes. The values of an axis in an experiment file are not recorded.
TEST_F(Hostile, AnAxisOfManyValuesIsNoCaseOfManyGigabytes) {
  folder.write("own.toml", of_torus("layers = [4]"));
  expect_refused(
      pelage("run own.toml --dry-run --axis wetness.seed=$(seq -s, 1 20000)"),
      "each of the 20000 cases records the values of --set and --axis, 2178 MB in total; the limit is 256 MB");
  std::string values = "[1";
  for (int i = 2; i <= 20'000; ++i) values += ", " + std::to_string(i);
  folder.write("long.toml", of_torus("layers = [4]\nwetness.seed = " + values + "]"));
  const Outcome dry = done("run long.toml --dry-run");
  EXPECT_EQ(std::count(dry.out.begin(), dry.out.end(), '\n'), 20'000);
  rusage use{};
  ASSERT_EQ(getrusage(RUSAGE_CHILDREN, &use), 0);
  EXPECT_LT(use.ru_maxrss, 1024L * 1024) << "KiB, the largest memory of a process of this test program";
}

TEST_F(Hostile, ControlCharactersOfNamesDoNotReachTheTerminal) {
  expect_refused(pelage("render -o \"$(printf 'a\\033[31mb\\007.jpg')\""),
                 "a\\x1b[31mb\\x07.jpg: a picture is written as .png, .exr or .tif");
}

TEST_F(Hostile, ABadLineOfAJournalNamesTheRemedyWhichWorks) {
  folder.write("own.toml", of_torus("layers = [4, 8]"));
  done("run own.toml -o out");
  const std::string journal = journal_in(folder, "out"), good = folder.read(journal);
  folder.write(journal, "damaged" + good);
  for (const char* command : {"run own.toml --resume out", "report out -o page"})
    expect_refused(pelage(command),
                   "restore this line from a copy, or delete it, and --resume runs its case again");
  folder.write(journal, good.substr(good.find('\n') + 1));
  expect_has(done("run own.toml --resume out").err, "1 cases ok");
}

TEST_F(Hostile, ACaseThatEndsInAnErrorGivesCode1AndIsTriedAgain) {
  folder.write("own.toml",
               experiment("model = [\"torus-24x12\", \"other.obj\"]\nlayers = [4]\nsize = [\"320x240\"]"));
  folder.write("other.obj", "no mesh\n");
  for (const char* command : {"run own.toml -o out", "run own.toml --resume out"}) {
    const Outcome outcome = pelage(command);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    expect_has(outcome.err, "1 cases not ok");
  }
}

// A user can interrupt pelage before it creates the results folder. pelage must then not advise the user to
// continue the run with --resume. It may end without any message.
TEST_F(Hostile, AnInterruptBeforeTheFirstRowAdvisesNoFolder) {
  folder.write("own.toml", of_torus("layers = [4]"));
  const std::string interrupted = "timeout -s INT ";
  for (const char* seconds : {"0.02", "0.05", "0.1", "0.2"}) {
    const Outcome outcome = pelage("run own.toml -o none", interrupted + seconds);
    if (fs::exists(folder.path / "none")) break;
    EXPECT_FALSE(has(outcome.err, "--resume")) << seconds << " s: " << outcome.err;
  }
}

}  // namespace
}  // namespace pelage::cli
