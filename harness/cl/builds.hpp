// The programs that were built for a device, so that each is built once in a process, and builds on a thread
// of their own, while the caller prepares the data for the programs. PoCL needs about 25 ms to preprocess a
// program, even if its cache has the compiled kernels.
#pragma once
#include <atomic>
#include <condition_variable>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "harness/cl/compile.hpp"

namespace pelage::cl {

/// Keeps the builds of a device as long as the device exists. Several threads may use an object at once.
class Builds {
 public:
  using Build = std::shared_ptr<const BuiltProgram>;
  /// Returns the build with the key `key`. If there is none, calls `build` for it. If another thread is
  /// building it, waits for this thread. A build that fails is not kept: its error is thrown in all threads
  /// that wait, and the next call builds again.
  Build get(const std::string& key, const std::function<Build()>& build);
  /// From hold() to release(), get() waits if it is called with this key.
  void hold(const std::string& key);
  void release(const std::string& key);

 private:
  std::mutex lock_;
  std::condition_variable released_;
  std::set<std::string> held_;
  std::map<std::string, std::shared_future<Build>> builds_;
};

/// Builds a list of programs. CompileProcesses compile their kernels first. A Program with a listed text on
/// the same device uses the build of this object, or waits for it. A build that fails is left to the Program
/// that needs it, whose constructor throws the error.
class BuildAhead {
 public:
  /// Starts to build the programs in the order of the list.
  BuildAhead(const Device& device, std::vector<ProgramText> texts);
  ~BuildAhead();  ///< stops the processes, and waits for the build that is running
  BuildAhead(const BuildAhead&) = delete;
  BuildAhead& operator=(const BuildAhead&) = delete;

 private:
  std::atomic<bool> stop_ = false;
  std::optional<CompileProcesses> processes_;
  std::thread thread_;
};

}  // namespace pelage::cl
