// Tests pelage tune with two bad configurations of the kernels: one computes a wrong picture, and one cannot
// run.
#include <gtest/gtest.h>

#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* smallest = "--preset smoke --filter torus-16 --rounds 6 ";

TEST(Tune, DryRunPrintsTheAxesAndStoresNothing) {
  const Folder folder;
  const Outcome dry = pelage(folder, "tune --dry-run");
  EXPECT_EQ(dry.code, 0) << dry.err;
  EXPECT_NE(dry.out.find("rasterize\tTILE_W\t32,8,16\t"), std::string::npos) << dry.out;
  EXPECT_NE(dry.err.find("nothing was run"), std::string::npos) << dry.err;
  EXPECT_FALSE(fs::exists(folder.path() / "pelage-tuning"));
  const Outcome bad = pelage(folder, "tune raster");
  EXPECT_EQ(bad.code, 2);
  EXPECT_NE(bad.err.find("the stages with tuning axes are rasterize"), std::string::npos) << bad.err;
}

TEST(Tune, APlantedWrongConfigurationIsTriedAndNotStored) {
  const Folder folder;
  fs::copy(fs::path(PELAGE_SOURCE_DIR) / "kernels", folder.path() / "kernels", fs::copy_options::recursive);
  // The test inserts two bad configurations into a copy of the kernels. If TILE_W is 8, the inserted code
  // regards a pixel as opaque at a transmittance of 0.9. With this code the kernel is fast, but its picture
  // is wrong. TILE_H = 7 is not a valid tile height.
  std::string params = folder.read("kernels/rasterize/params.h");
  const auto stop = params.find("#define OPAQUE ");
  ASSERT_NE(stop, std::string::npos);
  params.insert(params.find('\n', stop) + 1, "#if TILE_W == 8\n#undef OPAQUE\n#define OPAQUE 0.9f\n#endif\n");
  folder.write("kernels/rasterize/params.h", params);
  folder.write("kernels/rasterize/tuning.toml",
               "[TILE_W]\nwhat = \"planted\"\nvalues = [8]\n"
               "[TILE_H]\nwhat = \"no tile\"\nvalues = [7]\n");
  const Outcome tuned = pelage(folder, std::string("--kernels kernels tune rasterize -o t.toml ") + smallest);
  ASSERT_EQ(tuned.code, 0) << tuned.err;
  EXPECT_NE(tuned.out.find("rasterize\tTILE_W=8\tfailed: torus-16-320x240: psnr against reference"),
            std::string::npos)
      << tuned.out;
  EXPECT_NE(tuned.out.find("rasterize\tTILE_H=7\tfailed: tuning: TILE_H is 7"), std::string::npos)
      << tuned.out;
  EXPECT_NE(tuned.out.find("rasterize\tshipped\tstored"), std::string::npos) << tuned.out;
  EXPECT_EQ(folder.read("t.toml").find("TILE_W ="), std::string::npos);
  // pelage run accepts the stored file.
  const Outcome dry = pelage(folder, "run silva2010-table1 --tuning t.toml --dry-run");
  EXPECT_EQ(dry.code, 0) << dry.err;
}

TEST(Tune, ARunRecordsTheValuesItWasGiven) {
  const Folder folder;
  folder.write("mine.toml", "[rasterize]\nGROUP = 2\n");
  const Outcome run =
      pelage(folder, "run silva2010-table1 --preset smoke --filter torus-16 --tuning mine.toml -o out");
  ASSERT_EQ(run.code, 0) << run.err;
  std::string rows;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path() / "out"))
    if (entry.path().extension() == ".jsonl")
      rows = folder.read(fs::relative(entry.path(), folder.path()).string());
  EXPECT_NE(rows.find("\"tuning\":{\"GROUP\":2}"), std::string::npos) << rows;
  EXPECT_NE(rows.find("\"variant\":\"shells/tile/mine\""), std::string::npos) << rows;
}

}  // namespace
}  // namespace pelage::cli
