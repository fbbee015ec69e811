#include "harness/cl/builds.hpp"

#include <algorithm>
#include <exception>
#include <system_error>

#include "harness/cl/compile.hpp"
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

BuildAhead::BuildAhead(const Device& device, const std::vector<ProgramText>& texts) : device_(device) {
  for (const ProgramText& text : texts) {
    try {
      texts_.emplace_back(text, build_key(text));
      device_.builds().hold(texts_.back().second);
    } catch (const InputError&) {  // the Program that needs the text meets the same error
    }
  }
  const std::size_t count =
      std::min<std::size_t>(std::max(1u, std::thread::hardware_concurrency()), texts_.size());
  try {
    while (threads_.size() < count) threads_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {  // the system permits no further thread
    if (threads_.empty()) stop();
  }
#if defined(__SANITIZE_ADDRESS__)
  // isolated() calls fork(). If another thread allocates memory at that moment, GCC 12's AddressSanitizer
  // leaves its allocator locked in the child process, and the child process waits for ever. glibc does not.
  join();
#endif
}

void BuildAhead::work() {
  for (std::size_t i = 0; (i = next_++) < texts_.size();) {
    const auto& [text, key] = texts_[i];
    try {
      compile_elsewhere(device_, text, key);
    } catch (const std::exception&) {  // this process compiles the kernels
    }
    device_.builds().release(key);
    try {
      build_program(device_, text);
    } catch (const std::exception&) {  // the Program that needs the text meets the same error
    }
  }
}

void BuildAhead::stop() {
  const std::size_t begun = std::min(next_.exchange(texts_.size()), texts_.size());
  for (std::size_t i = begun; i < texts_.size(); ++i) device_.builds().release(texts_[i].second);
}

BuildAhead::~BuildAhead() {
  stop();
  join();
}

void BuildAhead::join() {
  for (std::thread& thread : threads_)
    if (thread.joinable()) thread.join();
}

}  // namespace pelage::cl
