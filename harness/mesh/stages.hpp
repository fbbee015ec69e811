// What a long preparation says about how far it is.
#pragma once
#include <chrono>
#include <functional>
#include <string>

namespace pelage {

/// Names the stages of a preparation on a callback, with the fraction of a stage that is done and the seconds
/// since the start: "cat.obj: laying the surface flat, 40%, 12 s".
class Stages {
 public:
  using Say = std::function<void(const std::string&)>;

  /// Says nothing during the first `silent_s` seconds, and a fraction at most every 2.5 times as long.
  Stages(Say say, std::string label, double silent_s);

  void begin(const std::string& stage);
  void part(double fraction);  ///< of the stage, 0 to 1
  /// The same as a callback, for the steps.
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
