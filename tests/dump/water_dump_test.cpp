// Tests that the dump of a frame whose water changes over time holds the arrival and the present wetness of
// every droplet (docs/shells.md, section 10).
#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>

#include "harness/dump/dump.hpp"
#include "harness/prepare/water.hpp"
#include "tests/support/files.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

std::vector<float> floats(hid_t file, const char* name) {
  const hid_t set = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(set);
  std::vector<float> values(std::size_t(H5Sget_simple_extent_npoints(space)));
  H5Dread(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space);
  H5Dclose(set);
  return values;
}

TEST(WaterDump, HoldsTheWetnessOfThePicture) {
  Scene scene = synthetic::lively_scene();
  scene.fur.layers = 2;
  scene.wetness.soak = .05f;
  scene.dynamics.topology = "silva";
  FrameInput input = synthetic::frame(scene, synthetic::torus(), 12, 8, 8);
  for (std::size_t i = 0; i < 8; ++i) input.droplets[i].arrival = .01f * float(i);
  constexpr int frames = 4;  // the picture at 0.05 s, with the default step and substeps
  std::string folder = (fs::temp_directory_path() / "pelage-dump-XXXXXX").string();
  ASSERT_TRUE(mkdtemp(folder.data()));
  const fs::path path = fs::path(folder) / "frame.h5";
  const FrameOutput output = reference_output(input, frames, false);
  write_dump(path, {input.scene, *input.mesh, output.image, output.pipeline, frames},
             [&](Hdf5File& file) { dump::write_shells(file, input, output); });
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const std::vector<float> arrival = floats(file, "droplet/arrival"), rho = floats(file, "droplet/rho"),
                           soaked = floats(file, "droplet/wetness");
  H5Fclose(file);
  ASSERT_EQ(rho.size(), 8u);
  const double time = picture_time(scene.dynamics, frames);
  ASSERT_NEAR(time, .05, 1e-6);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(soaked[i], input.droplets[i].wetness);
    EXPECT_EQ(arrival[i], input.droplets[i].arrival);
    const double part = std::clamp((time - double(arrival[i])) / .05, 0.0, 1.0);
    EXPECT_NEAR(rho[i], part * double(soaked[i]), 1e-6) << "droplet " << i;
  }
  EXPECT_EQ(rho[7], 0) << "this droplet has not arrived";
}

}  // namespace
}  // namespace pelage
