#include "harness/cl/buffer.hpp"

#include <numeric>

#include "harness/cl/program.hpp"
#include "harness/error.hpp"
#include "tests/support/texts.hpp"

using namespace pelage;

namespace {

template <class T>
concept MoveOnly = std::is_nothrow_move_constructible_v<T> && std::is_nothrow_move_assignable_v<T> &&
                   !std::is_copy_constructible_v<T> &&
                   !std::is_copy_assignable_v<T> && std::is_nothrow_destructible_v<T>;
static_assert(MoveOnly<cl::Queue> && MoveOnly<cl::Memory> && MoveOnly<cl::Buffer<float>> &&
              MoveOnly<cl::Program> && MoveOnly<cl::Event> && MoveOnly<cl::Kernel>);

// Types that Kernel::with() accepts as kernel arguments. A kernel must receive the OpenCL handle of a buffer,
// never the bytes of the Buffer object or a host pointer.
template <class T>
concept Argument = requires(cl::Kernel kernel, const T& value) {
  kernel.with(value);
};
static_assert(Argument<cl::Buffer<float>> && Argument<cl::Memory> && Argument<float> && Argument<cl_uint>);
static_assert(!std::is_trivially_copyable_v<cl::Buffer<float>> && !std::is_trivially_copyable_v<cl::Memory>);

}  // namespace

TEST(Buffers, ReturnWhatWasWritten) {
  const cl::Queue queue(cl::choose_device(""));
  std::vector<std::uint64_t> values(100'003);
  std::iota(values.begin(), values.end(), std::uint64_t{1} << 40);
  cl::Buffer<std::uint64_t> buffer(queue, values);
  EXPECT_EQ(buffer.read(queue), values);
  std::vector<std::uint64_t> part(5);
  buffer.read(queue, part, 99'998);
  EXPECT_TRUE(std::equal(part.begin(), part.end(), values.begin() + 99'998));
}

TEST(Buffers, OfNothingWork) {
  const cl::Queue queue(cl::choose_device(""));
  const cl::Buffer<float> buffer(queue, {});
  EXPECT_EQ(buffer.size(), 0u);
  EXPECT_NE(buffer.get(), nullptr);
  EXPECT_TRUE(buffer.read(queue).empty());
}

TEST(Buffers, MoveTheirMemory) {
  const cl::Queue queue(cl::choose_device(""));
  const std::vector<int> values{1, 2, 3};
  cl::Buffer<int> first(queue, values);
  cl::Buffer<int> second(std::move(first));
  cl::Buffer<int> third;
  third = std::move(second);
  EXPECT_EQ(third.read(queue), values);
}

TEST(Buffers, RefuseToOverrun) {
  const cl::Queue queue(cl::choose_device(""));
  cl::Buffer<int> buffer(queue.device(), 4);
  std::vector<int> five(5);
  EXPECT_THROW(buffer.write(queue, five), DeviceError);
  EXPECT_THROW(buffer.read(queue, five), DeviceError);
  std::vector<int> two(2);
  EXPECT_THROW(buffer.read(queue, two, 3), DeviceError);
}

TEST(Buffers, TooLargeSayHowMuchFits) {
  const cl::Device device = cl::choose_device("");
  const std::string said =
      test::refusal<DeviceError>([&] { const cl::Memory memory(device, device.info().max_allocation + 1); });
  test::expect_has(said, "at most");
}

TEST(Errors, CarryOpenClsName) {
  EXPECT_NO_THROW(cl::check(CL_SUCCESS, "clFinish"));
  const std::string said = test::refusal<DeviceError>([&] { cl::check(CL_OUT_OF_RESOURCES, "clFinish"); });
  EXPECT_EQ(said.find("clFinish: CL_OUT_OF_RESOURCES: "), 0u) << said;
  EXPECT_EQ(cl::error_name(-12345), "OpenCL error -12345");
}
