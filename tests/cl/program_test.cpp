#include "harness/cl/program.hpp"

#include <fmt/format.h>

#include <numeric>
#include <optional>

#include "harness/cl/builds.hpp"
#include "harness/cl/radix_sort.hpp"
#include "harness/error.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

using namespace pelage;

namespace {

struct Change {
  float scale;
  int shift;
};

struct Programs : test::InFolder {
  void SetUp() override { cl::set_kernel_folder(folder.path); }
  void TearDown() override { cl::set_kernel_folder(before_); }

  const fs::path before_ = cl::kernel_folder();
  cl::Device device_ = cl::choose_device("");
};

const char* const scaling = R"(
#include "factor.clh"
typedef struct { float scale; int shift; } Change;
__kernel void scaled(__global const float *in, Change pair, uint count, __global float *out) {
  size_t i = get_global_id(0);
  if (i < count) out[i] = FACTOR * pair.scale * in[i] + pair.shift;
}
__kernel void numbered(uint width, __global uint *out) { out[get_global_id(1) * width + get_global_id(0)] = get_global_id(1); }
)";

}  // namespace

TEST_F(Programs, TakeBuffersAndRecordsInOrder) {
  folder.write("factor.clh", "#ifndef FACTOR\n#define FACTOR 2\n#endif\n");
  folder.write("scaling.cl", scaling);
  const cl::Queue queue(device_);
  std::vector<float> values(1000);
  std::iota(values.begin(), values.end(), 0.0f);
  const cl::Buffer<float> in(queue, values);
  const cl::Buffer<float> out(device_, values.size());
  for (const auto& [options, factor] : {std::pair{"", 2.0f}, std::pair{"-D FACTOR=3", 3.0f}}) {
    const cl::Program program(device_, "scaling.cl", options);
    EXPECT_GT(program.build_ms(), 0);
    cl::Kernel kernel(program, "scaled");
    kernel.with(in, Change{0.5f, 7}, static_cast<cl_uint>(values.size()), out).enqueue(queue, 1024);
    const std::vector<float> result = out.read(queue);
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(result[i], factor * 0.5f * values[i] + 7) << i;
  }
}

TEST_F(Programs, LaunchTwoDimensions) {
  folder.write("factor.clh", "");
  folder.write("scaling.cl", scaling);
  const cl::Queue queue(device_);
  const cl::Buffer<std::uint32_t> out(device_, 12);
  const cl::Program program(device_, "scaling.cl", "-D FACTOR=1");
  cl::Kernel(program, "numbered").with(cl_uint{4}, out).enqueue(queue, {4, 3}, {1, 1});
  EXPECT_EQ(out.read(queue), (std::vector<std::uint32_t>{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2}));
}

// PoCL compiles a kernel again for each size of a work-group. The sizes of other drivers would be divisors of
// the number of work-items.
TEST_F(Programs, LaunchKernelsInGroupsOfOneSize) {
  folder.write(
      "groups.cl",
      "__kernel void sizes(uint count, __global uint *out) {\n"
      "  size_t i = get_global_id(0);\n"
      "  if (i < count) out[i] = get_local_size(0);\n"
      "  if (i == 0) out[count] = get_global_size(0);\n"
      "}\n"
      "__kernel __attribute__((reqd_work_group_size(32, 1, 1))) void required(uint count, __global uint *out) {\n"
      "  size_t i = get_global_id(0);\n"
      "  if (i < count) out[i] = get_local_size(0);\n"
      "}\n");
  const cl::Queue queue(device_);
  const cl::Program program(device_, "groups.cl");
  cl::Kernel sizes(program, "sizes"), required(program, "required");
  for (const std::uint32_t items : {1u, 302u, 585u, 1021u}) {
    const cl::Buffer<std::uint32_t> out(device_, items + 1);
    const auto expect = [&](std::uint32_t group) {
      const std::vector<std::uint32_t> found = out.read(queue);
      for (std::uint32_t i = 0; i < items; ++i) ASSERT_EQ(found[i], group) << items;
    };
    sizes.with(cl_uint{items}, out).enqueue(queue, items);
    expect(std::uint32_t(cl::usual_group(device_.info())));
    sizes.enqueue(queue, items, 16);
    expect(16);
    EXPECT_EQ(out.read(queue).back(), (items + 15) / 16 * 16);
    required.with(cl_uint{items}, out).enqueue(queue, items);
    expect(32);
    // No device has groups of this size.
    sizes.enqueue(queue, items, std::size_t(1) << 30);
    const std::uint32_t most = out.read(queue).front();
    EXPECT_LE(most, device_.info().max_work_group);
    EXPECT_GE(most, 16u);
    expect(most);
  }
}

TEST_F(Programs, WithTheSameTextAreBuiltOnce) {
  folder.write("factor.clh", "#ifndef FACTOR\n#define FACTOR 2 // not UNREAD\n#endif\n");
  folder.write("scaling.cl", scaling);
  const cl::Program first(device_, "scaling.cl", "-D FACTOR=3"), again(device_, "scaling.cl", "-D FACTOR=3");
  EXPECT_EQ(first.get(), again.get());
  EXPECT_NE(first.get(), cl::Program(device_, "scaling.cl", "-D FACTOR=4").get());
  EXPECT_EQ(first.get(), cl::Program(device_, "scaling.cl", "-D UNREAD=1 -D FACTOR=3 -D FACT").get());
  EXPECT_EQ(first.text().options, "-D FACTOR=3");
}

TEST_F(Programs, SeeAnEditedInclude) {
  const cl::Queue queue(device_);
  const cl::Buffer<std::uint32_t> out(device_, 1);
  folder.write("main.cl",
               "#include \"value.clh\"\n__kernel void value(__global uint *out) { out[0] = VALUE; }\n");
  for (const std::uint32_t value : {11u, 12u}) {
    folder.write("value.clh", fmt::format("#define VALUE {}\n", value));
    const cl::Program program(device_, "main.cl");
    cl::Kernel(program, "value").with(out).enqueue(queue, 1);
    EXPECT_EQ(out.read(queue).front(), value);
  }
}

TEST_F(Programs, FromAFolderWithASpace) {
  const fs::path spaced = folder.path / "two words";
  fs::create_directories(spaced);
  cl::set_kernel_folder(spaced);
  folder.write("two words/factor.clh", "#define FACTOR 1\n");
  folder.write("two words/scaling.cl", scaling);
  EXPECT_NO_THROW(cl::Program(device_, "scaling.cl"));
}

TEST_F(Programs, ThatDoNotBuildShowLogAndOptions) {
  folder.write("broken.cl", "__kernel void broken(__global float *out) { out[SOMETHING] = no_such_name; }\n");
  test::expect_has(test::refusal<DeviceError>([&] { cl::Program(device_, "broken.cl", "-D SOMETHING=1"); }),
                   {"CL_BUILD_PROGRAM_FAILURE", "no_such_name", "-D SOMETHING=1", "broken.cl"});
}

TEST_F(Programs, KeepTheLogOfWarnings) {
  folder.write("warned.cl",
               "#warning \"look here\"\n__kernel void fine(__global float *out) { out[0] = 1; }\n");
  test::expect_has(cl::Program(device_, "warned.cl").log(), "look here");
}

TEST_F(Programs, ThatAreMissingNameTheFile) {
  test::expect_has(test::refusal([&] { cl::Program(device_, "absent.cl"); }), "absent.cl");
  EXPECT_THROW(cl::set_kernel_folder(folder.path / "absent"), InputError);
}

TEST_F(Programs, NameAnUnknownKernelAndAWrongArgument) {
  folder.write("factor.clh", "");
  folder.write("scaling.cl", scaling);
  const cl::Program program(device_, "scaling.cl", "-D FACTOR=1");
  test::expect_has(test::refusal<DeviceError>([&] { cl::Kernel(program, "absent"); }),
                   {"CL_INVALID_KERNEL_NAME", "absent"});
  const cl::Buffer<std::uint32_t> out(device_, 1);
  cl::Kernel kernel(program, "numbered");
  EXPECT_THROW(kernel.with(std::uint64_t{1}, out), DeviceError);
}

TEST_F(Programs, TimeTheirEvents) {
  folder.write(
      "work.cl",
      "__kernel void work(__global float *out) { float x = get_global_id(0); for (int i = 0; i < 2000; ++i) x = fma(x, 0.5f, 1.0f); out[get_global_id(0)] = x; }\n");
  const cl::Queue queue(device_);
  const cl::Buffer<float> out(device_, 1 << 16);
  const cl::Program program(device_, "work.cl");
  cl::Kernel kernel(program, "work");
  kernel.with(out);
  kernel.enqueue(queue, out.size());
  queue.finish();
  const cl::Event event = kernel.enqueue(queue, out.size());
  queue.finish();
  const auto time = event.milliseconds(device_);
  if (device_.info().timer_resolution_ns == 0)
    EXPECT_FALSE(time.has_value());
  else
    EXPECT_GT(time.value(), 0.0);
  EXPECT_FALSE(cl::Event().milliseconds(device_).has_value());
}

// Tests the builds of programs on a thread of their own.

TEST(BuildAhead, AProgramUsesTheBuild) {
  const cl::Device device = cl::choose_device("");
  const std::vector<cl::ProgramText> texts = cl::PairSort::program_texts(device, 64);
  ASSERT_EQ(texts.size(), 2u);  // the sort and the prefix sums
  std::optional<cl::BuildAhead> ahead(std::in_place, device, texts);
  const cl::Program first(device, texts.front()), last(device, texts.back());
  ahead.reset();
  EXPECT_EQ(first.get(), cl::Program(device, texts.front()).get());
  EXPECT_NE(first.get(), last.get());
}

TEST(BuildAhead, BuildsProgramsThatNobodyAsksFor) {
  const cl::Device device = cl::choose_device("");
  const cl::ProgramText text = cl::PairSort::program_texts(device, 1).front();
  { const cl::BuildAhead ahead(device, {text}); }
  EXPECT_NO_THROW(cl::Kernel(cl::Program(device, text), "pair_total"));
}

TEST(BuildAhead, AnErrorReachesOnlyTheProgramThatNeedsTheBuild) {
  const cl::Device device = cl::choose_device("");
  const cl::ProgramText missing{"no/such/file.cl", ""}, text = cl::PairSort::program_texts(device, 1).front();
  const cl::BuildAhead ahead(device, {missing, text});
  EXPECT_NO_THROW(cl::Program(device, text));
  EXPECT_THROW(cl::Program(device, missing), InputError);
}
