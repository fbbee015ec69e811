// Water that changes over time: droplets arrive, soak into the fur and dry (docs/shells.md, section 10). All
// functions are pure functions of the time, so any picture of a sequence can be drawn without the pictures
// before it.
#pragma once
#include <string>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// An amount of water, divided by where it is. fell = unsoaked + held + evaporated + dripped. In the account
/// of a droplet the unit is 1 (wetness). In the account of all droplets it is R^2: wetness times area.
struct Water {
  double fell = 0;        ///< all water that has arrived
  double unsoaked = 0;    ///< on the fur, not yet soaked in
  double held = 0;        ///< in the fur; for a droplet, this is its present wetness rho(t)
  double evaporated = 0;  ///< lost by evaporation (wetness.drying)
  double dripped = 0;     ///< lost by dripping (wetness.drip)
};

/// A droplet with less present wetness than this is not blended into the mask.
inline constexpr float least_wetness = 1.0f / 1024.0f;

/// Returns where the water of a droplet is at the time `age` after its arrival, in s. `drop` is rho_drop.
/// Before the arrival, all values are 0.
Water water_of(const WetnessScene& wetness, double drop, double age);

/// True if the wetness of a droplet changes over time, or if a droplet arrives after the time 0.
bool water_changes(const WetnessScene& wetness, const std::vector<Droplet>& droplets);

/// True if droplet i is a repetition of the droplet before it across a UV seam.
inline bool repeats(const std::vector<Droplet>& droplets, std::size_t i) {
  return i > 0 && droplets[i].number != Droplet::alone && droplets[i].number == droplets[i - 1].number;
}

/// Returns rho(t), the wetness of the droplet at the time `seconds`; 0 if it is below least_wetness.
float present_wetness(const WetnessScene& wetness, const Droplet& droplet, double seconds);

/// Returns the wetness of each of the input's droplets in the picture after `frames` frames: rho(t), or
/// rho_drop if the water does not change.
std::vector<float> wetness_of_picture(const FrameInput& input, int frames);

/// Returns the droplets that are blended into the mask at the time `seconds`, in their order, with their
/// present wetness. These are the droplets with rho(t) > 0, or all droplets if the water does not change.
std::vector<Droplet> droplets_at(const WetnessScene& wetness, const std::vector<Droplet>& droplets,
                                 double seconds);

/// Sets the arrival of the random droplets, which begin at the index `first`. Droplet i of them arrives at
/// wetness.begin + i / wetness.rate, or at wetness.begin if the rate is 0. Removes those that would arrive
/// after wetness.end.
void set_arrivals(const WetnessScene& wetness, std::vector<Droplet>& droplets, std::size_t first);

/// Returns the sum of the water of all droplets at the time `seconds`, in R^2. The mass of a droplet is its
/// wetness times the area of its disc on the surface, pi r_drop^2 l_u l_v, where (l_u, l_v) is
/// Mesh::length_per_uv. Repetitions of a droplet across UV seams are not counted.
Water water_at(const WetnessScene& wetness, const std::vector<Droplet>& droplets, glm::vec2 length_per_uv,
               double seconds);

/// Returns the names of the columns of water_csv_line(), with a line break.
std::string water_csv_header();
/// Returns one line of a table: the time (s), the number of droplets in the mask, and the water as in
/// water_at().
std::string water_csv_line(const WetnessScene& wetness, const std::vector<Droplet>& droplets,
                           glm::vec2 length_per_uv, double seconds);
}  // namespace pelage
