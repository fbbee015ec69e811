#include "harness/measure/gpu_state.hpp"

#include "tests/support/files.hpp"

namespace pelage {
namespace {

TEST(GpuState, IsReadFromNvidiaSmi) {
  const std::string text =
      "NVIDIA A100, 1410, 1593, 33, 0x0000000000000001\nNVIDIA H200, 1980, 3201, 41, 0x0000000000000004\n";
  const auto state = gpu_state_of_nvidia(text, "NVIDIA H200");
  EXPECT_EQ(state.dump(), R"({"core_mhz":1980.0,"memory_mhz":3201.0,"celsius":41.0,"slowed":4})");
  EXPECT_EQ(gpu_state_of_nvidia("NVIDIA H200, [N/A], 3201, [N/A], [N/A]\n", "NVIDIA H200").dump(),
            R"({"memory_mhz":3201.0})");
  EXPECT_TRUE(gpu_state_of_nvidia(text, "GeForce").empty());
  EXPECT_TRUE(gpu_state_of_nvidia("NVIDIA-SMI has failed\n", "NVIDIA H200").empty());
}

struct CardState : test::InFolder {};

TEST_F(CardState, IsReadFromTheFilesOfDrivers) {
  fs::create_directories(folder.path / "amd/device/hwmon/hwmon3");
  folder.write("amd/device/pp_dpm_sclk", "0: 500Mhz\n1: 1500Mhz *\n2: 2100Mhz\n");
  folder.write("amd/device/pp_dpm_mclk", "0: 1200Mhz *\n");
  folder.write("amd/device/hwmon/hwmon3/temp1_input", "54000\n");
  EXPECT_EQ(gpu_state_of_card(folder.path / "amd").dump(),
            R"({"core_mhz":1500.0,"memory_mhz":1200.0,"celsius":54.0})");
  fs::create_directories(folder.path / "intel");
  folder.write("intel/gt_act_freq_mhz", "1150\n");
  EXPECT_EQ(gpu_state_of_card(folder.path / "intel").dump(), R"({"core_mhz":1150.0})");
  EXPECT_TRUE(gpu_state_of_card(folder.path / "none").empty());
}

TEST(GpuState, IsEmptyForOtherDevices) {
  EXPECT_TRUE(gpu_state(cl::DeviceInfo{}).empty());
}

}  // namespace
}  // namespace pelage
