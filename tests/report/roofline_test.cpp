// Tests the table and the plot of the roofline report.
#include "harness/report/roofline.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "harness/report/plot.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

const Ceilings ceilings{"a device, \"quoted\"", 40, 200};

std::vector<FrameWork> one_frame() {
  // The first kernel reads and writes 1 MB and computes 1e7 operations in 0.5 ms: 2 GB/s, 20 GFLOP/s and 10
  // operations per byte. At 10 operations per byte the ceilings allow 200 GFLOP/s.
  return {{"torus-16",
           9360,
           2.0,
           3e6,
           2e6,
           1e6,
           {{"tile_shells", "raster", 0.5, 1e6, 1e7}, {"bin_fill", "bin", 0.25, 5e5, 0}}}};
}

TEST(Roofline, TheRoofIsTheLowerOfTheTwo) {
  EXPECT_DOUBLE_EQ(allowed_gflop_s(ceilings, 1), 40);
  EXPECT_DOUBLE_EQ(allowed_gflop_s(ceilings, 5), 200);
  EXPECT_DOUBLE_EQ(allowed_gflop_s(ceilings, 100), 200);
}

TEST(Roofline, TheTableHasRatesAndSharesOfTheRoof) {
  const std::string csv = csv_of(one_frame(), ceilings);
  EXPECT_NE(
      csv.find(
          "torus-16,9360,2,3000000,2000000,1000000,tile_shells,raster,0.5,1000000,10000000,2,20,10,0.1\n"),
      std::string::npos)
      << csv;
  EXPECT_NE(csv.find("bin_fill,bin,0.25,500000,0,2,0,0,0\n"), std::string::npos) << csv;
  const std::string text = text_of(one_frame(), ceilings);
  EXPECT_NE(text.find("10.0%"), std::string::npos) << text;
  EXPECT_NE(text.find("between kernels            1.250   62.5%"), std::string::npos) << text;
}

TEST(Roofline, KernelsOfTwoPhasesAreNamedWithTheirPhase) {
  std::vector<FrameWork> frames = one_frame();
  frames[0].kernels.push_back({"bin_fill", "shadow", 0.125, 5e5, 0});
  const std::string text = text_of(frames, ceilings);
  EXPECT_NE(text.find("bin_fill, shadow"), std::string::npos) << text;
  EXPECT_NE(text.find("bin_fill, bin"), std::string::npos) << text;
  EXPECT_EQ(text.find("tile_shells, raster"), std::string::npos) << text;
}

TEST(Roofline, ThePlotIsDrawnFromTheTable) {
  std::string name = (fs::temp_directory_path() / "pelage-test-XXXXXX").string();
  const fs::path folder = mkdtemp(name.data());
  std::ofstream(folder / "t.csv") << csv_of(one_frame(), ceilings);
  EXPECT_EQ(draw_plot(plot_program("roofline"), folder / "t.csv", folder / "t"), "");
  std::ifstream stream(folder / "t.svg");
  const std::string svg{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_NE(svg.find("tile_shells"), std::string::npos);
  EXPECT_EQ(svg.find(">bin_fill<"), std::string::npos) << "no operations, no place under the roof";
  fs::remove_all(folder);
}

}  // namespace
}  // namespace pelage
