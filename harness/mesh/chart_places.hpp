// Finds free places in an atlas (the UV square with its charts) for more charts.
#pragma once
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "harness/mesh/surface.hpp"

namespace pelage {

/// The free space of the UV square. Charts keep a distance of 2/256 of the square's side from its border, and
/// an added chart keeps a distance of 4/256 from other charts, as the charts of packed() do (components.hpp).
class FreeSpace {
 public:
  FreeSpace();
  /// Marks the space that a triangle takes.
  void take(const Surface::Corners& uv);
  /// Finds a place for the bounding box of a chart, marks its space as taken, and returns its lower corner.
  /// Returns nothing if there is no place. `size` is the size of the box in UV.
  std::optional<glm::dvec2> place(glm::dvec2 size);

 private:
  void sum_up();
  bool is_free(int x, int y, int width, int height) const;

  std::vector<char> taken_;
  std::vector<int> sum_;  ///< number of taken cells below and to the left of each corner of a cell
  bool summed_ = false;
};

}  // namespace pelage
