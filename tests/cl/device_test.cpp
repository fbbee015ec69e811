#include "harness/cl/device.hpp"

#include <cstdio>
#include <cstdlib>
#include <set>

#include "harness/cl/buffer.hpp"
#include "harness/error.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

using namespace pelage;

TEST(Devices, AreListedWithWhatTheHarnessNeeds) {
  const auto all = cl::devices();
  ASSERT_FALSE(all.empty()) << "the tests need one OpenCL device: install pocl-opencl-icd";
  std::set<std::string> specs;
  for (const cl::Device& device : all) {
    EXPECT_FALSE(device.info().name.empty());
    EXPECT_FALSE(device.info().platform.empty());
    EXPECT_FALSE(device.info().driver.empty());
    EXPECT_GT(device.info().compute_units, 0u);
    EXPECT_GT(device.info().global_memory, 0u);
    EXPECT_GT(device.info().max_allocation, 0u);
    EXPECT_GT(device.info().max_work_group, 0u);
    EXPECT_TRUE(device.info().lanes == 1 || device.info().lanes == 16);
    EXPECT_TRUE(specs.insert(device.info().spec()).second) << device.info().spec() << " names two devices";
  }
}

TEST(Devices, CopiesShareOneContext) {
  const cl::Device device = cl::choose_device("");
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): the copy is what is tested
  const cl::Device copy = device;
  EXPECT_EQ(device.context(), copy.context());
  EXPECT_NE(device.context(), cl::choose_device("").context());
}

TEST(Devices, OneIsFoundByItsOwnSpecAndName) {
  for (const cl::Device& device : cl::devices()) {
    EXPECT_EQ(cl::choose_device(device.info().spec()).id(), device.id());
    EXPECT_EQ(cl::choose_device(device.info().name).info().name, device.info().name);
  }
}

namespace {

// The OpenCL loader ocl-icd searches for drivers once per process. Each test therefore runs in a new process,
// whose folder of driver entries is empty.
struct WithoutDriversDeathTest : test::InFolder {
  void SetUp() override {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    ::setenv("OCL_ICD_VENDORS", folder.path.c_str(), 1);
  }
  void TearDown() override { ::unsetenv("OCL_ICD_VENDORS"); }
};

[[noreturn]] void choose_and_exit(const char* wanted) {
  if (!cl::devices().empty() || !cl::platforms().empty()) std::exit(1);
  try {
    cl::choose_device(wanted);
  } catch (const NoDeviceError& error) {
    std::fputs(error.what(), stderr);
    std::exit(3);
  }
  std::exit(0);
}

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

TEST_F(WithoutDriversDeathTest, NoDeviceSaysWhatToInstall) {
  EXPECT_EXIT(choose_and_exit(""), ::testing::ExitedWithCode(3), "pocl-opencl-icd");
  EXPECT_EXIT(choose_and_exit("nvidia"), ::testing::ExitedWithCode(3), "no OpenCL device");
}

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
