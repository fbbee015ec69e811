#include "harness/cl/drivers.hpp"

#include <cstdlib>
#include <fstream>

#include "harness/cl/device.hpp"
#include "tests/support/files.hpp"

using namespace pelage;

namespace {

// Creates an empty folder for the loader's .icd files and a folder for drivers. Each test counts the OpenCL
// platforms in a new process, because the OpenCL loader searches for drivers once per process.
struct Drivers : test::InFolder {
  void SetUp() override {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    fs::create_directories(vendors);
    fs::create_directories(drivers);
    // The test preset asan sets OCL_ICD_VENDORS, which would override OPENCL_VENDOR_PATH.
    ::unsetenv("OCL_ICD_VENDORS");
    ::setenv("OPENCL_VENDOR_PATH", vendors.c_str(), 1);
    ::setenv("PELAGE_DRIVERS", drivers.c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("OPENCL_VENDOR_PATH");
    ::unsetenv("PELAGE_DRIVERS");
  }
  const fs::path vendors = folder.path / "vendors", drivers = folder.path / "drivers";
};

/// Returns the path of PoCL's library, which the tests use in place of NVIDIA's library.
fs::path some_library() {
  std::ifstream entry("/etc/OpenCL/vendors/pocl.icd");
  std::string name;
  std::getline(entry, name);
  const fs::path library = name;
  return library.is_absolute() ? library : fs::path("/usr/lib/x86_64-linux-gnu") / library;
}

[[noreturn]] void exit_with_platforms() {
  const std::string before = std::getenv("OPENCL_VENDOR_PATH");
  const std::size_t count = cl::platforms().size();
  // cl::platforms() must restore this variable, because child processes inherit it.
  if (std::getenv("OPENCL_VENDOR_PATH") != before) std::exit(99);
  std::exit(static_cast<int>(count));
}

using DriversDeathTest = Drivers;

TEST_F(DriversDeathTest, ALibraryThatNoEntryNamesIsFound) {
  if (!fs::exists(some_library()))
    GTEST_SKIP() << "PoCL, which stands in for NVIDIA's driver, is not installed";
  EXPECT_EXIT(exit_with_platforms(), ::testing::ExitedWithCode(0), "");
  fs::create_symlink(some_library(), drivers / "libnvidia-opencl.so.1");
  EXPECT_EXIT(exit_with_platforms(), ::testing::ExitedWithCode(1), "");
}

TEST_F(Drivers, TheLibraryIsTheFirstFoldersAndMayBeVersioned) {
  EXPECT_FALSE(cl::nvidia_library({folder.path / "nowhere", drivers}));
  std::ofstream(drivers / "libnvidia-opencl.so.550.54") << "";
  EXPECT_EQ(cl::nvidia_library({folder.path / "nowhere", drivers}), drivers / "libnvidia-opencl.so.550.54");
  std::ofstream(drivers / "libnvidia-opencl.so.1") << "";
  EXPECT_EQ(cl::nvidia_library({drivers}), drivers / "libnvidia-opencl.so.1");
  EXPECT_FALSE(cl::names_nvidia(vendors));
  std::ofstream(vendors / "pocl.icd") << "libpocl.so.2\n";
  EXPECT_FALSE(cl::names_nvidia(vendors));
  std::ofstream(vendors / "nvidia.icd") << "libnvidia-opencl.so.1\n";
  EXPECT_TRUE(cl::names_nvidia(vendors));
}

TEST(Threads, ArePinnedWhereAllCoresAreTheProcesss) {
  EXPECT_TRUE(cl::may_pin({0}, 1));
  EXPECT_TRUE(cl::may_pin({0, 1, 2, 3}, 4));
  EXPECT_FALSE(cl::may_pin({0, 1}, 4)) << "confined";
  EXPECT_FALSE(cl::may_pin({2, 3}, 2)) << "PoCL counts from core 0";
  EXPECT_FALSE(cl::may_pin({0, 2}, 2));
}

TEST(Threads, StayAsTheUserSays) {
  const char* before = std::getenv("POCL_AFFINITY");
  const std::string kept = before ? before : "";
  ::setenv("POCL_AFFINITY", "0", 1);
  cl::pin_threads();
  EXPECT_STREQ(std::getenv("POCL_AFFINITY"), "0");
  before ? ::setenv("POCL_AFFINITY", kept.c_str(), 1) : ::unsetenv("POCL_AFFINITY");
}

}  // namespace
