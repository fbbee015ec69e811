// Tests the builds of programs on a thread of their own.
#include <gtest/gtest.h>

#include <optional>

#include "harness/cl/builds.hpp"
#include "harness/cl/radix_sort.hpp"
#include "harness/error.hpp"

using namespace pelage;

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
