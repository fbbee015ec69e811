// Runs some tests of this binary under oclgrind, which checks the rules of the OpenCL API and every access to
// a buffer.
#include "tests/support/oclgrind.hpp"

#include <cstdlib>

#include "harness/cl/program.hpp"
#include "tests/support/texts.hpp"

using namespace pelage;

namespace {

std::string complaints(const std::string& tests) {
  const UnderOclgrind run = under_oclgrind(tests, "--data-races --uninitialized");
  return run.status == 0 ? run.log : run.log + "the tests failed under oclgrind: " + run.printed;
}

}  // namespace

TEST_F(Oclgrind, HasNothingToSayOfTheHostLayer) {
  EXPECT_EQ(complaints("Buffers.*:Devices.*:Programs.TakeBuffersAndRecordsInOrder:Written.*-*TooLarge*"), "");
}

TEST_F(Oclgrind, SeesAPlantedOverrun) {
  ::setenv("PELAGE_TEST_INDEX", "4", 1);
  const std::string said = complaints("Written.*");
  ::unsetenv("PELAGE_TEST_INDEX");
  test::expect_has(said, "Invalid write");
}

// Writes to the element PELAGE_TEST_INDEX of a buffer of four floats, or to the last one.
TEST(Written, WhereTheHostSays) {
  const char* planted = std::getenv("PELAGE_TEST_INDEX");
  const fs::path before = cl::kernel_folder();
  const test::Folder folder;
  folder.write("write.cl", "__kernel void write(int i, __global float *out) { out[i] = 1; }\n");
  cl::set_kernel_folder(folder.path);
  const cl::Queue queue(cl::choose_device(""));
  const std::vector<float> zeros(4);
  const cl::Buffer<float> out(queue, zeros);
  cl::Kernel kernel(cl::Program(queue.device(), "write.cl"), "write");
  kernel.with(planted != nullptr ? std::atoi(planted) : 3, out).enqueue(queue, 1, 1);
  if (planted == nullptr) {
    EXPECT_EQ(out.read(queue).back(), 1.0f);
  }
  queue.finish();
  cl::set_kernel_folder(before);
}
