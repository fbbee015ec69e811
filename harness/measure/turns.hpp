// Times several subjects in turns: in every round, a frame of the first and then one of each other. The
// machine's speed changes from minute to minute, so the times of one round are compared with each other.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "harness/measure/subject.hpp"

namespace pelage {

/// A subject that takes turns with the first one. `name` is the phase of the row that has its times.
struct Turn {
  std::string name;
  std::unique_ptr<Subject> subject;
};

/// What differs between the uses of Turns.
struct TurnRules {
  /// Returns the checks of another subject. `timed` is the picture of the first subject.
  std::function<std::vector<Check>(const Turn& other, const Picture& timed)> check;
  /// Adds the metrics of another subject to the row; may be empty.
  std::function<void(const Turn& other, Row& row)> describe = {};
  /// False: the row has the metric NAME_ratio (ratio_metric()). True: the first subject is compared with
  /// simpler work, and the row has the metric frame_over_NAME (frame_over_metric()).
  bool frame_over = false;
  /// True: every round begins with another subject, so that no subject is always the first or the last.
  bool rotate = false;
};

/// In a row, the phase "frame" has the times of the first subject, and each other subject has a phase of its
/// own. The other subjects' metrics that compare times are the medians over the rounds, with their 95%
/// intervals. The picture is that of the first subject.
class Turns : public Subject {
 public:
  Turns(std::unique_ptr<Subject> first, std::vector<Turn> others, TurnRules rules);
  FrameSample frame() override;
  Picture read() override { return first_->read(); }
  std::vector<Check> check(const Picture& timed) override;
  void describe(Row& row) override;

 private:
  std::unique_ptr<Subject> first_;
  std::vector<Turn> others_;
  TurnRules rules_;
  std::size_t round_ = 0;
};

/// Returns the checks of the other subject's own picture, with its name: "reference, NAME".
std::vector<Check> own_checks(const Turn& other, const Picture& timed);

}  // namespace pelage
