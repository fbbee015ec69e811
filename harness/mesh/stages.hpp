// Progress messages of a long mesh preparation.
#pragma once
#include <chrono>
#include <functional>
#include <string>

namespace pelage {

/// Sends the current stage of a preparation to a callback, with the stage's completed fraction and the
/// seconds since the construction of the Stages object. Example: "cat.obj: computing the UV map, 40%, 12 s".
class Stages {
 public:
  using Say = std::function<void(const std::string&)>;

  /// No messages are sent during the first `silent_s` seconds after the construction. Messages with a
  /// completed fraction are at least 2.5 * silent_s seconds apart.
  Stages(Say say, std::string label, double silent_s);

  void begin(const std::string& stage);
  void part(double fraction);  ///< completed fraction of the stage, 0 to 1
  /// Returns a callback that takes the completed fraction of the stage and passes it to part().
  std::function<void(double)> parts();

 private:
  using Clock = std::chrono::steady_clock;
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  Say say_;
  std::string label_, stage_;
  double silent_s_, told_ = 0;
  Clock::time_point start_ = Clock::now();
};

}  // namespace pelage
