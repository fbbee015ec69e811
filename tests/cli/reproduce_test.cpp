// Tests `pelage reproduce` with a small paper of its own.
#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

struct Reproduce : InFolder {
  Reproduce() {
    const fs::path own = folder.path / "data/experiments";
    fs::create_directories(own / "papers");
    for (const char* shared : {"examples", "kernels", "readings", "shaders"})
      fs::create_symlink(fs::path(PELAGE_SOURCE_DIR) / shared, folder.path / "data" / shared);
    fs::copy_file(fs::path(PELAGE_SOURCE_DIR) / "experiments/models.toml", own / "models.toml");
    folder.write("data/experiments/tori.toml", R"toml(name = "tori"
title = "Tori"
paper = "the-paper"
[axes]
model = ["torus-24x12"]
layers = [4, 8]
[scene]
image.width = 320
image.height = 240
[preset.smoke]
warm_up_s = 0.0
least = 3
most = 3
precision = 0.5
limit_s = 20.0
axes.layers = [4]
[preset.quick]
warm_up_s = 0.0
least = 9
most = 9
precision = 0.02
limit_s = 20.0
)toml");
    folder.write("data/experiments/claims.toml", R"toml([[claim]]
id = "more-layers"
statement = "More layers take longer."
source = { paper = "the-paper", section = "7" }
rows = { experiment = "tori", cases = 1 }
effect = { name = "ratio", axis = "layers", of = "8", to = "4" }
relation = { at_most = 100 }
)toml");
    folder.write("data/experiments/papers/mine.toml", R"toml(paper = "the-paper"
title = "On Tori"
authors = "A. Nobody (2001)"
[[table]]
title = "Table 7"
caption = "Our tori."
experiment = "tori"
[[figure]]
title = "Figure 3"
caption = "A factor and a torus."
differs = "The torus is ours."
panels = [
  { label = "the factor", scene = "wet", diagram = "shape", options = ["--set", "fur.layers=4"] },
  { label = "a torus", scene = "straight", options = ["--model", "torus-24x12", "--set", "fur.layers=4"] },
]
[[missing]]
what = "Figure 4"
why = "It is a drawing."
)toml");
  }
  const std::string data = "PELAGE_DATA=data";
};

TEST_F(Reproduce, WritesOnePageAndContinues) {
  done("reproduce --preset smoke -o out", data);
  const std::string page = folder.read("out/page/index.html");
  expect_has(page, {"On Tori", "A. Nobody (2001)", "Table 7", "Our tori.", "Figure 3", "The torus is ours.",
                    "(a) the factor", "(b) a torus", "data:image/webp", "It is a drawing.",
                    "1 claims are not tested"});
  expect_has(page, {"<li>More layers take longer.</li>"});
  // The case with 8 layers is only in the preset quick.
  expect_has(page,
             {">skipped</td>",
              "smoke measured 1 cases of its own, most with smaller pictures or models. skipped: 1 cases",
              "<p class=\"answer\">Frame: "});
  expect_has(folder.read("out/lengths.csv"), {"smoke,tori,", "smoke,mine figures,"});
  const Outcome again = done("reproduce mine --preset smoke --resume out", data);
  expect_has(again.err, "experiment 1 of 1: tori, 1 cases; about 5 s left");
  expect_has(again.err, "1 kept from the interrupted run");

  // The preset quick judges the claim.
  done("reproduce mine --anonymous -o judged", data);
  const std::string judged = folder.read("judged/page/index.html");
  expect_has(judged, {"More layers take longer", "the-paper, section 7", "<tr id=\"claim-more-layers\">"});
  expect_lacks(judged, "skipped");
}

TEST_F(Reproduce, SaysWhatItWouldRun) {
  const Outcome dry = done("reproduce --dry-run", data);
  EXPECT_EQ(dry.out, "experiment\tpreset\tcases\tlength\ntori\tquick\t2\t10 s\n")
      << "without a length of an earlier run, 5 s per case";
  expect_has(dry.err, "1 experiments with 2 cases, 1 figures: about 15 s; nothing was run");
  EXPECT_FALSE(fs::exists(folder.path / "pelage-results"));
  // The length of an earlier run, on a machine that was slower by far than this one.
  folder.write("data/experiments/papers/lengths.csv", "quick,tori,3600,0.001\nquick,mine figures,60,0.001\n");
  expect_has(done("reproduce --dry-run", data).err, "about 0 s; nothing was run");
  folder.write("data/experiments/papers/lengths.csv", "quick,tori\n");
  expect_refused(pelage("reproduce --dry-run", data),
                 "lengths.csv:1: must be PRESET,EXPERIMENT,SECONDS,SPEED");
  fs::remove(folder.path / "data/experiments/papers/lengths.csv");
  expect_refused(pelage("reproduce other", data), "other: no such paper; known: mine");
  const Outcome shipped = done("reproduce --dry-run --preset smoke");
  expect_has(shipped.out, {"silva2010-table1\tsmoke", "demoreuille2011-full\tsmoke",
                           "wetfur2010-fig06\tquick, size=200x150"});
}

// A picture that cannot be drawn is named on the page, and the exit code is 1.
TEST_F(Reproduce, NamesWhatFailed) {
  std::string plan = folder.read("data/experiments/papers/mine.toml");
  plan.replace(plan.find("torus-24x12"), 11, "no-model.obj");
  folder.write("data/experiments/papers/mine.toml", plan);
  const Outcome outcome = pelage("reproduce --preset smoke -o out", data);
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  expect_has(folder.read("out/page/index.html"),
             {"(b) a torus: not drawn", "the picture &quot;a torus&quot; is missing"});
}

// A page that is made again says so again.
TEST_F(Reproduce, NamesExperimentsWithFailedChecks) {
  folder.write("data/experiments/tori.toml",
               folder.read("data/experiments/tori.toml") + "\n[require]\ntriangles = 1e9\n");
  for (const char* where : {"-o out", "--resume out"}) {
    const Outcome outcome = pelage(fmt::format("reproduce --preset smoke {}", where), data);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    expect_has(folder.read("out/page/index.html"), "tori: some cases have no time");
  }
}

}  // namespace
}  // namespace pelage::cli
