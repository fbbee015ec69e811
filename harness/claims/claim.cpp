#include "harness/claims/claim.hpp"

#include <fmt/format.h>

namespace pelage::claims {
namespace {

std::string quantity_of(const Claim& claim) {
  std::string text;
  switch (claim.quantity) {
    case Quantity::frame_time:
      text = claim.phases.empty() ? "frame time" : "frame time in turns";
      break;
    case Quantity::frame_rate:
      text = claim.phases.empty() ? "frame rate" : "frame rate in turns";
      break;
    case Quantity::phase_time:
      text = fmt::format("time of {}", claim.phase);
      break;
    case Quantity::phase_share:
      text = fmt::format("share of {} in the frame time", claim.phase);
      break;
    case Quantity::metric:
      text = claim.metric;
      break;
  }
  return claim.per.empty() ? text : fmt::format("{} per {}", text, claim.per);
}

std::string effect_of(const Claim& claim) {
  const std::string quantity = quantity_of(claim);
  const std::string& against = claim.along.empty() ? claim.axis : claim.along;
  switch (claim.effect) {
    case Effect::level:
      break;
    case Effect::ratio:
      return fmt::format("{}, {} {} : {}", quantity, claim.axis, claim.of, claim.to);
    case Effect::ratio_by_phase:
      return fmt::format("frame time by the change of {}, {} {} : {}", claim.phase, claim.axis, claim.of,
                         claim.to);
    case Effect::elasticity:
      return fmt::format("elasticity of {} in {}", quantity, against);
    case Effect::linearity:
      return fmt::format("{}, slope in upper {} : slope in lower {}", quantity, against, against);
    case Effect::ratio_trend:
      return fmt::format("slope of log({}, {} {} : {}) in log({})", quantity, claim.axis, claim.of, claim.to,
                         claim.along.empty() ? claim.across : claim.along);
    case Effect::share_of_cases:
      return fmt::format("share of cases with {} of at least {:g}", quantity, claim.threshold);
  }
  return quantity;
}

const char* combination_of(const Claim& claim) {
  switch (claim.combine) {
    case Combine::every:
      return "every case";
    case Combine::geometric_mean:
      return "geometric mean";
    case Combine::mean:
      return "mean";
    case Combine::median:
      break;
  }
  return "median";
}

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
  if (claim.effect == Effect::share_of_cases) return effect_of(claim);
  return fmt::format("{}, {}", effect_of(claim), combination_of(claim));
}

}  // namespace pelage::claims
