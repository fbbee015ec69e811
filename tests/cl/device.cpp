#include "harness/cl/device.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "harness/cl/buffer.hpp"
#include "harness/error.hpp"

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
    EXPECT_TRUE(specs.insert(device.spec()).second) << device.spec() << " names two devices";
  }
}

TEST(Devices, CopiesShareOneContext) {
  const cl::Device device = cl::choose_device("");
  const cl::Device copy = device;
  EXPECT_EQ(device.context(), copy.context());
  EXPECT_NE(device.context(), cl::choose_device("").context());
}
