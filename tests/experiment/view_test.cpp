#include "harness/experiment/view.hpp"

#include <nlohmann/json.hpp>

#include "harness/experiment/experiment.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

View view_of(const std::string& report) {
  const test::Folder folder;
  folder.write("e.toml", "name = \"own\"\n[axes]\nmodel = [\"torus\"]\n[preset.quick]\nleast = 2\n" + report);
  return read_experiment(folder.path / "e.toml").view;
}

TEST(View, ReadsTheTable) {
  const View view = view_of(
      "[report]\nx = \"layers\"\ny = [\"median_ms\", \"error_rms\"]\nseries = \"model\"\npanels = [\"size\"]\n"
      "scale = [\"linear\", \"log\"]\nblocks = \"reading\"\ncolumns = \"size\"\nvalues = \"fps\"\nmarks = \"bars\"\nprogram = \"scaling\"\n");
  EXPECT_EQ(view, (View{.blocks = {"reading"},
                        .columns = {"size"},
                        .values = {"fps"},
                        .x = "layers",
                        .y = {"median_ms", "error_rms"},
                        .series = {"model"},
                        .panels = {"size"},
                        .x_scale = "linear",
                        .y_scale = "log",
                        .marks = "bars",
                        .program = "scaling"}));
  EXPECT_EQ(view_of(""), View{});
  EXPECT_EQ(view_of("[report]\nscale = \"log\"\n").x_scale, "log");
  EXPECT_EQ(view_of("[report]\nscale = \"log\"\n").y_scale, "log");
}

TEST(View, RowsStoreIt) {
  const View view{.blocks = {"reading"}, .x = "layers", .y = {"fps"}, .y_scale = "log", .marks = "bars"};
  EXPECT_EQ(view_from_json(to_json(view)), view);
  EXPECT_TRUE(to_json(View{}).empty());
  // A user may have edited the rows. view_from_json() must ignore values of a wrong type.
  for (const char* text :
       {"null", "3", "[1]", "{\"x\": 3, \"y\": \"fps\", \"series\": [1, {}], \"other\": []}"})
    EXPECT_EQ(view_from_json(nlohmann::json::parse(text)), View{}) << text;
}

TEST(View, BadTablesAreRefusedWithTheirLine) {
  test::expect_refusals(
      {{"[report]\nz = \"layers\"\n",
        "e.toml:7: report: the key z is unknown or has no meaning here (known here: blocks, columns, marks, panels"},
       {"[report]\nx = 3\n", "e.toml:7: report: x must be a string"},
       {"[report]\ny = []\n", "e.toml:7: report: y must be a string or a list of strings"},
       {"[report]\nseries = [1]\n", "e.toml:7: report: series must be a string or a list of strings"},
       {"[report]\nscale = [\"log\", \"log\", \"log\"]\n", "e.toml:7: report: scale must be"},
       {"[report]\nmarks = \"pies\"\n", "e.toml:7: report: marks must be \"bars\""},
       {"[report]\nscale = \"cubic\"\n", "e.toml:7: report: scale must be \"linear\" or \"log\""}},
      view_of);
}

}  // namespace
}  // namespace pelage
