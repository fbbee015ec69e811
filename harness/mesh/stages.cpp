#include "harness/mesh/stages.hpp"

#include <fmt/format.h>

namespace pelage {

Stages::Stages(Say say, std::string label, double silent_s)
    : say_(std::move(say)), label_(std::move(label)), silent_s_(silent_s) {}

void Stages::begin(const std::string& stage) {
  stage_ = stage;
  const double now = seconds();
  if (!say_ || now < silent_s_) return;
  say_(fmt::format("{}: {}, {:.0f} s", label_, stage_, now));
  told_ = now;
}

void Stages::part(double fraction) {
  const double now = seconds();
  if (!say_ || now < silent_s_ || now - told_ < 2.5 * silent_s_) return;
  say_(fmt::format("{}: {}, {:.0f}%, {:.0f} s", label_, stage_, 100 * fraction, now));
  told_ = now;
}

std::function<void(double)> Stages::parts() {
  return [this](double fraction) { part(fraction); };
}

}  // namespace pelage
