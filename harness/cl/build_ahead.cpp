#include "harness/cl/build_ahead.hpp"

#include <algorithm>
#include <atomic>
#include <future>
#include <mutex>
#include <thread>
#include <utility>

namespace pelage::cl {

struct BuildAhead::State {
  struct Build {
    ProgramText text;
    std::promise<std::shared_ptr<const BuiltProgram>> promise;
    std::shared_future<std::shared_ptr<const BuiltProgram>> result = promise.get_future().share();
    bool used = false;
  };
  Device device;
  std::vector<Build> builds;
  std::atomic<bool> stop = false;
  std::thread thread;

  // The existing objects. A Program deep inside a pipeline finds its build here, so that the classes in
  // between need not pass it on.
  static inline std::mutex lock;
  static inline std::vector<State*> existing;

  explicit State(Device on) : device(std::move(on)) {}

  void build_all() {
    for (Build& build : builds) {
      if (stop) {
        build.promise.set_value(nullptr);
        continue;
      }
      try {
        build.promise.set_value(build_program(device, build.text));
      } catch (...) {
        build.promise.set_exception(std::current_exception());
      }
    }
  }
};

BuildAhead::BuildAhead(const Device& device, std::vector<ProgramText> texts)
    : state_(std::make_unique<State>(device)) {
  for (ProgramText& text : texts) {
    State::Build build;
    build.text = std::move(text);
    state_->builds.push_back(std::move(build));
  }
  {
    const std::lock_guard guard(State::lock);
    State::existing.push_back(state_.get());
    state_->thread = std::thread([state = state_.get()] { state->build_all(); });
  }
#if defined(__SANITIZE_ADDRESS__)
  // isolated() calls fork(). If another thread allocates memory at that moment, GCC 12's AddressSanitizer
  // leaves its allocator locked in the child process, and the child process waits for ever. glibc does not.
  for (const State::Build& build : state_->builds) build.result.wait();
#endif
}

BuildAhead::~BuildAhead() {
  {
    const std::lock_guard guard(State::lock);
    std::erase(State::existing, state_.get());
  }
  state_->stop = true;
  state_->thread.join();
}

std::vector<ProgramText> BuildAhead::unused() const {
  const std::lock_guard guard(State::lock);
  std::vector<ProgramText> texts;
  for (const State::Build& build : state_->builds)
    if (!build.used) texts.push_back(build.text);
  return texts;
}

std::shared_ptr<const BuiltProgram> BuildAhead::take(const Device& device, const ProgramText& text) {
  std::shared_future<std::shared_ptr<const BuiltProgram>> result;
  {
    const std::lock_guard guard(State::lock);
    for (State* state : State::existing) {
      if (state->device.context() != device.context()) continue;
      for (State::Build& build : state->builds)
        if (build.text == text) {
          build.used = true;
          result = build.result;
        }
    }
  }
  return result.valid() ? result.get() : nullptr;
}

}  // namespace pelage::cl
