#include "harness/cl/builds.hpp"

#include <exception>
#include <system_error>

#include "harness/error.hpp"

namespace pelage::cl {

Builds::Build Builds::get(const std::string& key, const std::function<Build()>& build) {
  std::promise<Build> promise;
  std::shared_future<Build> others;
  {
    std::unique_lock guard(lock_);
    released_.wait(guard, [&] { return !held_.contains(key); });
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

void Builds::hold(const std::string& key) {
  const std::lock_guard guard(lock_);
  held_.insert(key);
}

void Builds::release(const std::string& key) {
  {
    const std::lock_guard guard(lock_);
    held_.erase(key);
  }
  released_.notify_all();
}

BuildAhead::BuildAhead(const Device& device, std::vector<ProgramText> texts) {
  std::vector<std::string> keys;
  std::erase_if(texts, [&](const ProgramText& text) {
    try {
      keys.push_back(build_key(text));
      return false;
    } catch (const InputError&) {  // the Program that needs the text meets the same error
      return true;
    }
  });
  processes_.emplace(device, texts);
  for (const std::string& key : keys) device.builds().hold(key);
  const auto work = [this, device, texts, keys] {
    processes_->wait();
    for (const std::string& key : keys) device.builds().release(key);
    for (const ProgramText& text : texts) {
      if (stop_) return;
      try {
        build_program(device, text);
      } catch (const std::exception&) {  // the Program that needs the text meets the same error
      }
    }
  };
  try {
    thread_ = std::thread(work);
  } catch (const std::system_error&) {  // the system permits no further thread
    work();
    return;
  }
#if defined(__SANITIZE_ADDRESS__)
  // isolated() calls fork(). If another thread allocates memory at that moment, GCC 12's AddressSanitizer
  // leaves its allocator locked in the child process, and the child process waits for ever. glibc does not.
  thread_.join();
#endif
}

BuildAhead::~BuildAhead() {
  stop_ = true;
  processes_->stop();
  if (thread_.joinable()) thread_.join();
}

}  // namespace pelage::cl
