#include "harness/shells/opencl/style_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/prepare/fur_texture.hpp"
#include "harness/shells/opencl/params.hpp"

namespace pelage::shells {
namespace {

/// The factors of curl.turns of a scene's vertices: multiples of 1 / turn_steps from `first` to `last`.
struct Turns {
  int first, last;
  explicit Turns(const std::vector<float>& shares) {
    const auto [least, most] = std::minmax_element(shares.begin(), shares.end());
    first = int(std::lround(*least * turn_steps));
    last = int(std::lround(*most * turn_steps));
  }
};

/// Appends the number of each vertex's factor of curl.turns, and the cosine and sine of the curl's angle for
/// each layer and factor.
void append_turns(const Scene& scene, const std::vector<float>& shares, std::vector<float>& table) {
  const Turns turns(shares);
  for (const float share : shares) table.push_back(float(std::lround(share * turn_steps) - turns.first));
  for (int n = 0; n < scene.fur.layers; ++n)
    for (int level = turns.first; level <= turns.last; ++level) {
      const float number = scene.curl.turns * (float(level) / turn_steps);
      const double angle = 2.0 * std::numbers::pi * double(number) * ((1.0 + n) / scene.fur.layers);
      table.push_back(float(std::cos(angle)));
      table.push_back(float(std::sin(angle)));
    }
}

}  // namespace

void place_maps(const FrameInput& input, const Geometry& geometry, RasterParams& params) {
  int end = LAYER_COLUMNS * params.layers;
  if (!geometry.turns.empty()) {
    const Turns turns(geometry.turns);
    params.turn_levels = turns.last - turns.first + 1;
    params.turn_points = end;
    params.turn_angles = end + int(geometry.turns.size());
    end = params.turn_angles + 2 * params.turn_levels * params.layers;
  }
  params.density = input.scene.fur.density;
  params.coverage_power = float(coverage_power(input.scene.fur));
  params.density_width = input.style.density.width;
  params.density_height = input.style.density.height;
  params.density_map = end;
}

std::vector<float> styled_layer_table(const FrameInput& input, const Geometry& geometry) {
  std::vector<float> table = layer_table(input.scene);
  if (!geometry.turns.empty()) append_turns(input.scene, geometry.turns, table);
  const std::vector<float>& density = input.style.density.value;
  table.insert(table.end(), density.begin(), density.end());
  return table;
}

}  // namespace pelage::shells
