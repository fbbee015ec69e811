#include "harness/cl/builds.hpp"

#include <exception>
#include <utility>

namespace pelage::cl {

Builds::Build Builds::get(const std::string& key, const std::function<Build()>& build) {
  std::promise<Build> promise;
  std::shared_future<Build> others;
  {
    const std::lock_guard guard(lock_);
    const auto [found, is_new] = builds_.try_emplace(key, promise.get_future().share());
    if (!is_new) others = found->second;
  }
  if (others.valid()) return others.get();
  try {
    Build built = build();
    promise.set_value(built);
    return built;
  } catch (...) {
    {
      const std::lock_guard guard(lock_);
      builds_.erase(key);
    }
    promise.set_exception(std::current_exception());
    throw;
  }
}

BuildAhead::BuildAhead(const Device& device, std::vector<ProgramText> texts)
    : thread_([this, device, texts = std::move(texts)] {
        for (const ProgramText& text : texts) {
          if (stop_) return;
          try {
            build_program(device, text);
          } catch (const std::exception&) {  // the Program that needs the text meets the same error
          }
        }
      }) {
#if defined(__SANITIZE_ADDRESS__)
  // isolated() calls fork(). If another thread allocates memory at that moment, GCC 12's AddressSanitizer
  // leaves its allocator locked in the child process, and the child process waits for ever. glibc does not.
  thread_.join();
#endif
}

BuildAhead::~BuildAhead() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

}  // namespace pelage::cl
