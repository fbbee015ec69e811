#include "harness/claims/claim.hpp"

#include <fmt/format.h>

namespace pelage::claims {
namespace {

std::string quantity_of(const Claim& claim) {
  std::string text = claim.metric;
  if (claim.quantity == Quantity::frame_time) text = "frame time";
  if (claim.quantity == Quantity::frame_rate) text = "frame rate";
  if (claim.quantity == Quantity::phase_time) text = fmt::format("time of the phase {}", claim.phase);
  if (claim.quantity == Quantity::phase_share)
    text = fmt::format("fraction of the frame time that the phase {} takes", claim.phase);
  return claim.per.empty() ? text : fmt::format("{} divided by {}", text, claim.per);
}

std::string ratio_of(const Claim& claim, const std::string& quantity) {
  return fmt::format("{} with {} = {}, divided by the value with {} = {}", quantity, claim.axis, claim.of,
                     claim.axis, claim.to);
}

std::string effect_words(const Claim& claim) {
  const std::string quantity = quantity_of(claim);
  const std::string& against = claim.along.empty() ? claim.axis : claim.along;
  switch (claim.effect) {
    case Effect::level:
      break;
    case Effect::ratio:
      return ratio_of(claim, quantity);
    case Effect::ratio_by_phase:
      return fmt::format("{}, if only the time of the phase {} differed", ratio_of(claim, "frame time"),
                         claim.phase);
    case Effect::elasticity:
      return fmt::format("elasticity of the {} with respect to {}", quantity, against);
    case Effect::linearity:
      return fmt::format("slope of the {} above the middle value of {}, divided by the slope below it",
                         quantity, against);
    case Effect::ratio_trend:
      return fmt::format("slope of the logarithm of the ratio ({}) against the logarithm of {}",
                         ratio_of(claim, quantity), claim.along.empty() ? claim.across : claim.along);
    case Effect::share_of_cases:
      return fmt::format("fraction of the cases with a {} of at least {:g}", quantity, claim.threshold);
  }
  return quantity;
}

/// Texts of Combine::every, geometric_mean, mean and median.
constexpr const char* combination_names[] = {"each case", "geometric mean over the cases",
                                             "mean over the cases", "median over the cases"};

}  // namespace

bool Region::contains(double value) const {
  return contains(value, value);
}

bool Region::contains(double from, double to) const {
  return (!low || (strict ? from > *low : from >= *low)) && (!high || (strict ? to < *high : to <= *high));
}

bool Region::outside(double from, double to) const {
  return (low && (strict ? to <= *low : to < *low)) || (high && (strict ? from >= *high : from > *high));
}

std::string description_of(const Claim& claim) {
  if (!claim.untestable.empty()) return {};
  const std::string alternately = claim.phases.empty() ? "" : "; one process drew the cases alternately";
  if (claim.effect == Effect::share_of_cases) return effect_words(claim) + alternately;
  return fmt::format("{}; {}{}", effect_words(claim), combination_names[std::size_t(claim.combine)],
                     alternately);
}

}  // namespace pelage::claims
