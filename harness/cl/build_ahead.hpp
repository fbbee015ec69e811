// Builds OpenCL programs on a thread of its own, while the caller prepares the data for them. PoCL needs
// about 25 ms to preprocess a program, even if its cache has the compiled kernels.
#pragma once
#include <atomic>
#include <thread>
#include <vector>

#include "harness/cl/program.hpp"

namespace pelage::cl {

/// Builds a list of programs. A Program with a listed text on the same device uses the build of this object,
/// or waits for it. A build that fails is left to the Program that needs it, whose constructor throws the
/// error.
class BuildAhead {
 public:
  /// Starts to build the programs in the order of the list.
  BuildAhead(const Device& device, std::vector<ProgramText> texts);
  ~BuildAhead();  ///< waits for the build that is running; starts no other
  BuildAhead(const BuildAhead&) = delete;
  BuildAhead& operator=(const BuildAhead&) = delete;

 private:
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace pelage::cl
