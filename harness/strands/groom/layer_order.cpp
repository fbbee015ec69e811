#include <algorithm>
#include <glm/vec4.hpp>
#include <numeric>
#include <tuple>

#include "harness/error.hpp"
#include "harness/strands/groom/fur.hpp"

namespace pelage::strands {

std::vector<std::uint8_t> layer_ranks(std::span<const LayerBounds> bounds, const Camera& camera,
                                      std::span<const float> biases, std::span<const int> offsets) {
  const std::size_t count = bounds.size();
  if (count > 256 || biases.size() != count || offsets.size() != count)
    throw InputError(
        "order of the fur layers: give one bias and one offset per layer, for at most 256 layers");
  const glm::dvec4 row(camera.row_w);
  const auto depth = [&](std::size_t i) {
    const glm::dvec3 centre = 0.5 * (glm::dvec3(bounds[i].low) + glm::dvec3(bounds[i].high));
    return row.x * centre.x + row.y * centre.y + row.z * centre.z + row.w + double(biases[i]);
  };
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return depth(a) < depth(b); });
  std::vector<std::tuple<long, int, std::size_t>> places;  // place, offset, layer
  for (std::size_t k = 0; k < count; ++k)
    places.emplace_back(long(k) + offsets[order[k]], offsets[order[k]], order[k]);
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) {
    return std::tie(std::get<0>(a), std::get<1>(a)) < std::tie(std::get<0>(b), std::get<1>(b));
  });
  std::vector<std::uint8_t> ranks(count);
  for (std::size_t k = 0; k < count; ++k) ranks[std::get<2>(places[k])] = std::uint8_t(k);
  return ranks;
}

}  // namespace pelage::strands
