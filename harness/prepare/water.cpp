#include "harness/prepare/water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pelage {
namespace {

/// Calls use(droplet) for each droplet that is not the repetition of another one.
template <class Use>
void for_each_own(const std::vector<Droplet>& droplets, const Use& use) {
  for (std::size_t i = 0; i < droplets.size(); ++i)
    if (!repeats(droplets, i)) use(droplets[i]);
}

/// Divides the water of a soaked droplet. The wetness follows d rho/dt = -rho / drying - drip until it is 0.
/// With x = t / drying, the solution is rho = drop e^-x - drip drying (1 - e^-x).
Water soaked(const WetnessScene& wetness, double drop, double t) {
  const double drying = double(wetness.drying), drip = double(wetness.drip);
  double wet_for = t;  // the time in which the droplet has lost water
  if (drip > 0) wet_for = drying > 0 ? drying * std::log1p(drop / (drip * drying)) : drop / drip;
  Water water{.fell = drop};
  water.dripped = std::min(drip * std::min(t, wet_for), drop);
  if (drip > 0 && t >= wet_for) {
    water.held = 0;
  } else if (drying > 0) {
    const double x = t / drying;
    water.held = std::clamp(drop * std::exp(-x) + drip * drying * std::expm1(-x), 0.0, drop - water.dripped);
  } else {
    water.held = drop - water.dripped;
  }
  if (drying > 0) water.evaporated = std::max(0.0, drop - water.dripped - water.held);
  return water;
}

}  // namespace

Water water_of(const WetnessScene& wetness, double drop, double age) {
  if (!(age >= 0)) return {};
  const double soak = double(wetness.soak);
  if (age >= soak) return soaked(wetness, drop, age - soak);
  const double held = drop * (age / soak);
  return {.fell = drop, .unsoaked = drop - held, .held = held};
}

bool water_changes(const WetnessScene& wetness, const std::vector<Droplet>& droplets) {
  if (droplets.empty()) return false;
  return wetness.soak > 0 || wetness.drying > 0 || wetness.drip > 0 ||
         std::any_of(droplets.begin(), droplets.end(), [](const Droplet& d) { return d.arrival > 0; });
}

float present_wetness(const WetnessScene& wetness, const Droplet& droplet, double seconds) {
  const Water water = water_of(wetness, double(droplet.wetness), seconds - double(droplet.arrival));
  const float rho = float(water.held);
  return rho >= least_wetness ? rho : 0.0f;
}

std::vector<float> wetness_of_picture(const FrameInput& input, int frames) {
  const bool changes = water_changes(input.scene.wetness, input.droplets);
  const double time = picture_time(input.scene.dynamics, frames);
  std::vector<float> rho;
  rho.reserve(input.droplets.size());
  for (std::size_t i = 0; i < input.droplets.size(); ++i) {
    const Droplet& d = input.droplets[i];
    if (!changes)
      rho.push_back(d.wetness);
    else
      rho.push_back(repeats(input.droplets, i) ? rho.back() : present_wetness(input.scene.wetness, d, time));
  }
  return rho;
}

std::vector<Droplet> droplets_at(const WetnessScene& wetness, const std::vector<Droplet>& droplets,
                                 double seconds) {
  if (!water_changes(wetness, droplets)) return droplets;
  std::vector<Droplet> wet;
  wet.reserve(droplets.size());
  for (Droplet droplet : droplets) {
    droplet.wetness = present_wetness(wetness, droplet, seconds);
    if (droplet.wetness > 0) wet.push_back(droplet);
  }
  return wet;
}

void set_arrivals(const WetnessScene& wetness, std::vector<Droplet>& droplets, std::size_t first) {
  const double begin = double(wetness.begin), rate = double(wetness.rate);
  for (std::size_t i = first; i < droplets.size(); ++i) {
    const double arrival = rate > 0 ? begin + double(i - first) / rate : begin;
    if (arrival > double(wetness.end)) {
      droplets.erase(droplets.begin() + std::ptrdiff_t(i), droplets.end());
      return;
    }
    droplets[i].arrival = float(arrival);
  }
}

Water water_at(const WetnessScene& wetness, const std::vector<Droplet>& droplets, glm::vec2 length_per_uv,
               double seconds) {
  const double per_uv = std::numbers::pi * double(length_per_uv.x) * double(length_per_uv.y);
  // With radii in R, the reach of a droplet is 2 max(l_u, l_v) / sqrt(l_u l_v) times its radius in R.
  const double per_reach = std::numbers::pi / 4 * double(std::min(length_per_uv.x, length_per_uv.y)) /
                           double(std::max(length_per_uv.x, length_per_uv.y));
  Water all;
  for_each_own(droplets, [&](const Droplet& droplet) {
    const Water own = water_of(wetness, double(droplet.wetness), seconds - double(droplet.arrival));
    const double area = wetness.unit == "surface" ? per_reach * double(droplet.reach) * double(droplet.reach)
                                                  : per_uv * double(droplet.radius) * double(droplet.radius);
    all.fell += area * own.fell;
    all.unsoaked += area * own.unsoaked;
    all.held += area * own.held;
    all.evaporated += area * own.evaporated;
    all.dripped += area * own.dripped;
  });
  return all;
}

std::string water_csv_header() {
  return "time_s,droplets,fell,unsoaked,held,evaporated,dripped\n";
}

std::string water_csv_line(const WetnessScene& wetness, const std::vector<Droplet>& droplets,
                           glm::vec2 length_per_uv, double seconds) {
  std::size_t count = 0;
  for_each_own(droplets_at(wetness, droplets, seconds), [&](const Droplet&) { ++count; });
  const Water water = water_at(wetness, droplets, length_per_uv, seconds);
  return fmt::format("{:.9g},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", seconds, count, water.fell,
                     water.unsoaked, water.held, water.evaporated, water.dripped);
}

}  // namespace pelage
