#include "harness/report/profile.hpp"

#include "harness/report/plot_spec.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

const Bandwidth bandwidth{"a device, \"quoted\"", 4};

std::vector<FrameWork> one_frame() {
  // The first kernel reads and writes 1 MB in 0.5 ms: 2 GB/s, 50% of the bandwidth.
  return {{"torus-16",
           9360,
           2.0,
           3e6,
           2e6,
           1e6,
           {{"tile_shells", "raster", 0.5, 1e6}, {"bin_fill", "bin", 0.25, 5e5}}}};
}

TEST(Profile, TheTableHasRatesAndSharesOfTheBandwidth) {
  test::expect_has(csv_of(one_frame(), bandwidth),
                   {"torus-16,9360,2,3000000,2000000,1000000,tile_shells,raster,0.5,1000000,2\n",
                    "bin_fill,bin,0.25,500000,2\n"});
  const std::string text = text_of(one_frame(), bandwidth);
  test::expect_has(text,
                   {"0.500   25.0%      1.00     2.00    50.0%", "between kernels            1.250   62.5%",
                    "9360      2.00      3.00      2.00      1.00         1.0\n"});
  std::vector<FrameWork> frames = one_frame();
  frames[0].shaded = frames[0].kernels[0].ms = 0;
  test::expect_has(text_of(frames, bandwidth), "      0.0\n");
  test::expect_has(csv_of(frames, bandwidth), "tile_shells,raster,0,1000000,0\n");
}

TEST(Profile, KernelsOfTwoPhasesAreNamedWithTheirPhase) {
  std::vector<FrameWork> frames = one_frame();
  frames[0].kernels.push_back({"bin_fill", "shadow", 0.125, 5e5});
  const std::string text = text_of(frames, bandwidth);
  test::expect_has(text, {"bin_fill, shadow", "bin_fill, bin"});
  test::expect_lacks(text, "tile_shells, raster");
}

TEST(Profile, ThePlotIsDrawnFromTheTable) {
  const test::Folder folder;
  const auto table = folder.path / "t.csv";
  test::write_text(table, csv_of(one_frame(), bandwidth));
  EXPECT_EQ(draw_plot(plot_program("profile"), table, folder.path / "t"), "");
  test::expect_has(folder.read("t.svg"), {">raster<", "between kernels"});
}

}  // namespace
}  // namespace pelage
