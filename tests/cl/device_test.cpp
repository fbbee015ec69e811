#include "harness/cl/device.hpp"

#include <cstdio>
#include <cstdlib>
#include <set>

#include "harness/cl/buffer.hpp"
#include "harness/error.hpp"
#include "tests/support/files.hpp"

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

TEST_F(WithoutDriversDeathTest, NoDeviceSaysWhatToInstall) {
  EXPECT_EXIT(choose_and_exit(""), ::testing::ExitedWithCode(3), "pocl-opencl-icd");
  EXPECT_EXIT(choose_and_exit("nvidia"), ::testing::ExitedWithCode(3), "no OpenCL device");
}

}  // namespace
