// Compares the programs that a pipeline is expected to need with those that it builds.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "harness/cl/program.hpp"

namespace pelage::test {

/// Expects that the programs of `expected` are those of `built`.
inline void expect_same_programs(const cl::Device& device, const std::vector<cl::ProgramText>& expected,
                                 const std::vector<const cl::Program*>& built) {
  std::set<cl_program> wanted, found;
  for (const cl::ProgramText& text : expected) {
    const cl::Program program(device, text);  // the build that the pipeline used, if it used the text
    wanted.insert(program.get());
    EXPECT_TRUE(std::any_of(built.begin(), built.end(), [&](auto* b) { return b->get() == program.get(); }))
        << "not built: " << text.file << " " << text.options;
  }
  for (const cl::Program* program : built) found.insert(program->get());
  EXPECT_EQ(wanted, found);
}

/// Expects that the sources of each program read every macro of its build options.
inline void expect_read_options(const std::vector<const cl::Program*>& built) {
  for (const cl::Program* program : built)
    EXPECT_EQ(cl::options_read(program->text().options, cl::source_texts(program->file())),
              program->text().options)
        << program->file();
}

}  // namespace pelage::test
