// Tests the builds of programs on a thread of their own.
#include "harness/cl/build_ahead.hpp"

#include <gtest/gtest.h>

#include "harness/cl/pair_sort.hpp"
#include "harness/error.hpp"

using namespace pelage;

TEST(BuildAhead, AProgramUsesTheBuild) {
  const cl::Device device = cl::choose_device("");
  const std::vector<cl::ProgramText> texts = cl::PairSort::program_texts(device, 64);
  ASSERT_EQ(texts.size(), 2u);  // the sort and the prefix sums
  const cl::BuildAhead ahead(device, texts);
  EXPECT_EQ(ahead.unused(), texts);
  const cl::Program first(device, texts.front()), again(device, texts.front());
  EXPECT_EQ(first.get(), again.get());
  EXPECT_EQ(ahead.unused(), std::vector(1, texts.back()));
  const cl::PairSort sort(device, 64);
  EXPECT_TRUE(ahead.unused().empty());
}

TEST(BuildAhead, OtherOptionsAreAnotherProgram) {
  const cl::Device device = cl::choose_device("");
  const cl::ProgramText text = cl::PairSort::program_texts(device, 1).front();
  const cl::BuildAhead ahead(device, {text});
  const cl::Program other(device, {text.file, text.options + " -D UNUSED_NAME=1"});
  EXPECT_EQ(ahead.unused().size(), 1u);
  const cl::Program same(device, text);
  EXPECT_NE(other.get(), same.get());
}

TEST(BuildAhead, AProgramOutlivesTheObject) {
  const cl::Device device = cl::choose_device("");
  const cl::ProgramText text = cl::PairSort::program_texts(device, 1).front();
  std::optional<cl::BuildAhead> ahead(std::in_place, device, std::vector{text});
  const cl::Program program(device, text);
  ahead.reset();
  EXPECT_NO_THROW(cl::Kernel(program, "pair_total"));
  EXPECT_NE(cl::Program(device, text).get(), program.get());
}

TEST(BuildAhead, AnErrorReachesOnlyTheProgramThatNeedsTheBuild) {
  const cl::Device device = cl::choose_device("");
  const cl::ProgramText missing{"no/such/file.cl", ""}, text = cl::PairSort::program_texts(device, 1).front();
  const cl::BuildAhead ahead(device, {missing, text});
  EXPECT_NO_THROW(cl::Program(device, text));
  EXPECT_THROW(cl::Program(device, missing), InputError);
}
