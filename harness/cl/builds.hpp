// The programs that were built for a device, so that each is built once in a process.
#pragma once
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace pelage::cl {

struct BuiltProgram;

/// Keeps the builds of a device as long as the device exists. Several threads may use an object at once.
class Builds {
 public:
  using Build = std::shared_ptr<const BuiltProgram>;
  /// Returns the build with the key `key`. If there is none, calls `build` for it. If another thread is
  /// building it, waits for this thread. A build that fails is not kept: its error is thrown in all threads
  /// that wait, and the next call builds again.
  Build get(const std::string& key, const std::function<Build()>& build);

 private:
  std::mutex lock_;
  std::map<std::string, std::shared_future<Build>> builds_;
};

}  // namespace pelage::cl
