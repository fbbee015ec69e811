#include "harness/cl/device.hpp"
#include "harness/error.hpp"
#include "tests/support/texts.hpp"

using namespace pelage;

namespace {

cl::DeviceInfo device(int platform_index, int device_index, const char* platform, const char* suffix,
                      const char* name, bool gpu) {
  cl::DeviceInfo info;
  info.platform_index = platform_index;
  info.device_index = device_index;
  info.platform = platform;
  info.platform_suffix = suffix;
  info.name = name;
  info.gpu = gpu;
  info.cpu = !gpu;
  return info;
}

// The devices of an imaginary workstation: PoCL, two equal GPUs and Mesa's rusticl. Platform 1 has no
// devices, so no device in this list has the platform index 1.
const std::vector<cl::DeviceInfo> workstation{
    device(0, 0, "Portable Computing Language", "POCL", "pthread-AMD EPYC 9454", false),
    device(2, 0, "NVIDIA CUDA", "NV", "NVIDIA H100 80GB HBM3", true),
    device(2, 1, "NVIDIA CUDA", "NV", "NVIDIA H100 80GB HBM3", true),
    device(3, 0, "rusticl", "MESA", "llvmpipe (LLVM 15.0.6, 256 bits)", false)};

std::string refusal(std::string_view wanted) {
  return test::refusal([&] { cl::choose(workstation, wanted, "--device"); });
}

}  // namespace

TEST(Choose, NamesOfEveryForm) {
  const std::vector<std::vector<const char*>> names{
      {"0:0", "Portable Computing Language:0", "pocl", "epyc", "PTHREAD-amd", "portable"},
      {"NV:0"},
      {"2:1", "nvidia:1"},
      {"rusticl", "llvmpipe", "mesa:0", "MESA", "(LLVM 15.0.6,"}};
  for (std::size_t position = 0; position < names.size(); ++position)
    for (const char* wanted : names[position])
      EXPECT_EQ(cl::choose(workstation, wanted, "--device"), position) << wanted;
}

TEST(Choose, NothingNamedIsTheFirstGpuElseACpu) {
  EXPECT_EQ(cl::choose(workstation, "", "--device"), 1u);
  EXPECT_EQ(cl::choose({workstation[3], workstation[0]}, "", "--device"), 0u);
}

TEST(Choose, AnAmbiguousNameListsItsCandidates) {
  const std::string text = refusal("h100");
  test::expect_has(text, {"2:0 NVIDIA H100", "2:1 NVIDIA H100"});
  test::expect_lacks(text, "pthread");
  EXPECT_NE(refusal("NVIDIA H100 80GB HBM3").find("several"), std::string::npos) << "two devices of one name";
}

TEST(Choose, AnUnknownNameListsEveryDevice) {
  for (const char* wanted :
       {"radeon", "1:0", "0:7", "nvidia:2", "0:99999", ":0", "0:", ":", "0:-1", "0:0:0"}) {
    const std::string text = refusal(wanted);
    EXPECT_EQ(text.find("--device " + std::string(wanted) + ": no such device"), 0u) << text;
    test::expect_has(text, "0:0 pthread");
  }
}

TEST(Choose, AmongNoneIsItsOwnError) {
  EXPECT_THROW(cl::choose({}, "0:0", "--device"), NoDeviceError);
}
