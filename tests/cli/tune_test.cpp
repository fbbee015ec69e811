// Tests pelage tune with two bad configurations of the kernels: one computes a wrong picture, and one cannot
// run.
#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

constexpr const char* smallest = "--preset smoke --filter torus-16 --rounds 6 ";

struct Tune : InFolder {};

TEST_F(Tune, DryRunPrintsTheAxesAndStoresNothing) {
  const Outcome dry = done("tune --dry-run");
  expect_has(dry.out, "rasterize\tTILE_W\t32,8,16\t");
  expect_has(dry.err, "nothing was run");
  EXPECT_FALSE(fs::exists(folder.path / "pelage-tuning"));
}

TEST_F(Tune, APlantedWrongConfigurationIsTriedAndNotStored) {
  fs::copy(fs::path(PELAGE_SOURCE_DIR) / "kernels", folder.path / "kernels", fs::copy_options::recursive);
  // If TILE_W is 8, a pixel counts as opaque at a transmittance of 0.9: the kernel is fast, but its picture
  // is wrong. TILE_H = 7 is not a valid tile height.
  const std::string opaque = "#define OPAQUE 0.001953125f";
  folder.edit("kernels/rasterize/params.h", opaque,
              "#if TILE_W == 8\n#define OPAQUE 0.9f\n#else\n" + opaque + "\n#endif");
  folder.write("kernels/rasterize/tuning.toml",
               "[TILE_W]\nwhat = \"planted\"\nvalues = [8]\n"
               "[TILE_H]\nwhat = \"no tile\"\nvalues = [7]\n");
  expect_has(done(std::string("--kernels kernels tune rasterize -o t.toml ") + smallest).out,
             {"rasterize\tTILE_W=8\tfailed: torus-16-320x240: psnr against reference",
              "rasterize\tTILE_H=7\tfailed: tuning: TILE_H is 7", "rasterize\tshipped\tstored"});
  expect_lacks(folder.read("t.toml"), "TILE_W =");
  done("run silva2010-table1 --tuning t.toml --dry-run");
}

TEST_F(Tune, ARunRecordsTheValuesItWasGiven) {
  folder.write("mine.toml", "[rasterize]\nGROUP = 2\n");
  done("run silva2010-table1 --preset smoke --filter torus-16 --tuning mine.toml -o out");
  expect_has(folder.read(journal_in(folder, "out")),
             {"\"tuning\":{\"GROUP\":2}", "\"variant\":\"shells/tile/mine\""});
}

}  // namespace
}  // namespace pelage::cli
