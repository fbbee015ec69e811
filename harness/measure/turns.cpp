#include "harness/measure/turns.hpp"

#include <fmt/format.h>

#include "harness/measure/statistics.hpp"
#include "harness/record/ratios.hpp"

namespace pelage {

Turns::Turns(std::unique_ptr<Subject> first, std::vector<Turn> others, TurnRules rules)
    : first_(std::move(first)), others_(std::move(others)), rules_(std::move(rules)) {}

FrameSample Turns::frame() {
  const std::size_t count = others_.size() + 1, begin = rules_.rotate ? round_++ % count : 0;
  FrameSample sample{};
  std::map<std::string, double> wall, cpu;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = (begin + i) % count;
    if (at == 0) {
      sample = first_->frame();
      continue;
    }
    const Turn& other = others_[at - 1];
    const FrameSample theirs = other.subject->frame();
    wall[other.name] = theirs.wall_ms;
    if (theirs.cpu_ms) cpu[other.name] = *theirs.cpu_ms;
  }
  sample.phase_wall_ms.merge(wall);
  sample.phase_cpu_ms.merge(cpu);
  return sample;
}

std::vector<Check> Turns::check(const Picture& timed) {
  std::vector<Check> checks = first_->check(timed);
  for (const Turn& other : others_)
    for (Check& check : rules_.check(other, timed)) checks.push_back(std::move(check));
  return checks;
}

void Turns::describe(Row& row) {
  first_->describe(row);
  // The peak of the memory belongs to a process that contains all subjects.
  row.metrics.erase("peak_memory");
  for (const Turn& other : others_) {
    const std::vector<double>&frame = row.samples["frame"].wall_ms, &theirs = row.samples[other.name].wall_ms;
    if (rules_.frame_over)
      row.metrics[frame_over_metric(other.name)] = median_ratio(frame, theirs);
    else
      row.metrics[ratio_metric(other.name)] = median_ratio(theirs, frame);
    if (rules_.describe) rules_.describe(other, row);
  }
}

std::vector<Check> own_checks(const Turn& other, const Picture&) {
  std::vector<Check> checks = other.subject->check(other.subject->read());
  for (Check& check : checks) check.against = fmt::format("{}, {}", check.against, other.name);
  return checks;
}

}  // namespace pelage
