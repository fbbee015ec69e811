#include "harness/subjects/opengl.hpp"

#include "harness/compare/pictures.hpp"
#include "harness/measure/statistics.hpp"

namespace pelage {
namespace {

class Duel : public Subject {
 public:
  Duel(std::unique_ptr<Subject> ours, std::unique_ptr<Subject> rival, std::string phase)
      : ours_(std::move(ours)), rival_(std::move(rival)), phase_(std::move(phase)) {}

  FrameSample frame() override {
    FrameSample sample = ours_->frame();
    const FrameSample theirs = rival_->frame();
    sample.phase_wall_ms[phase_] = theirs.wall_ms;
    if (theirs.cpu_ms) sample.phase_cpu_ms[phase_] = *theirs.cpu_ms;
    return sample;
  }
  Picture read() override { return ours_->read(); }
  std::vector<Check> check(const Picture& timed) override {
    std::vector<Check> checks = ours_->check(timed);
    for (Check& check : other_filter_checks(phase_, compare(timed, rival_->read())))
      checks.push_back(std::move(check));
    return checks;
  }
  void describe(Row& row) override {
    ours_->describe(row);
    Row other;
    rival_->describe(other);
    row.metrics[phase_ + "_build_ms"] = {other.build_ms, "ms"};
    for (const auto& [key, value] : other.provenance.items())
      if (!row.provenance.contains(key)) row.provenance[key] = value;
    row.identity.insert(other.identity.begin(), other.identity.end());
    row.metrics[phase_ + "_ratio"] = median_ratio(row.samples[phase_].wall_ms, row.samples["frame"].wall_ms);
  }

 private:
  std::unique_ptr<Subject> ours_, rival_;
  std::string phase_;
};

}  // namespace

std::unique_ptr<Subject> duel(std::unique_ptr<Subject> ours, std::unique_ptr<Subject> rival,
                              const std::string& phase) {
  return std::make_unique<Duel>(std::move(ours), std::move(rival), phase);
}

}  // namespace pelage
