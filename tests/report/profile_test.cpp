#include "harness/report/profile.hpp"

#include <gtest/gtest.h>

#include "harness/report/plot_spec.hpp"
#include "tests/support/files.hpp"

namespace pelage {
namespace {

const Bandwidth bandwidth{"a device, \"quoted\"", 40};

std::vector<FrameWork> one_frame() {
  // The first kernel reads and writes 1 MB in 0.5 ms: 2 GB/s, 5% of the bandwidth.
  return {{"torus-16",
           9360,
           2.0,
           3e6,
           2e6,
           1e6,
           {{"tile_shells", "raster", 0.5, 1e6}, {"bin_fill", "bin", 0.25, 5e5}}}};
}

TEST(Profile, TheTableHasRatesAndSharesOfTheBandwidth) {
  const std::string csv = csv_of(one_frame(), bandwidth);
  EXPECT_NE(csv.find("torus-16,9360,2,3000000,2000000,1000000,tile_shells,raster,0.5,1000000,2\n"),
            std::string::npos)
      << csv;
  EXPECT_NE(csv.find("bin_fill,bin,0.25,500000,2\n"), std::string::npos) << csv;
  const std::string text = text_of(one_frame(), bandwidth);
  EXPECT_NE(text.find("    5.0%"), std::string::npos) << text;
  EXPECT_NE(text.find("between kernels            1.250   62.5%"), std::string::npos) << text;
}

TEST(Profile, KernelsOfTwoPhasesAreNamedWithTheirPhase) {
  std::vector<FrameWork> frames = one_frame();
  frames[0].kernels.push_back({"bin_fill", "shadow", 0.125, 5e5});
  const std::string text = text_of(frames, bandwidth);
  EXPECT_NE(text.find("bin_fill, shadow"), std::string::npos) << text;
  EXPECT_NE(text.find("bin_fill, bin"), std::string::npos) << text;
  EXPECT_EQ(text.find("tile_shells, raster"), std::string::npos) << text;
}

TEST(Profile, ThePlotIsDrawnFromTheTable) {
  const test::Folder folder;
  const auto table = folder.path / "t.csv";
  test::write_text(table, csv_of(one_frame(), bandwidth));
  EXPECT_EQ(draw_plot(plot_program("profile"), table, folder.path / "t"), "");
  const std::string svg = test::text_of(folder.path / "t.svg");
  EXPECT_NE(svg.find(">raster<"), std::string::npos);
  EXPECT_NE(svg.find("between kernels"), std::string::npos);
}

}  // namespace
}  // namespace pelage
