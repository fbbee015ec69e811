#include "harness/cl/builds.hpp"

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

}  // namespace pelage::cl
