// Computes properties of the fur in one state of a mass-spring topology: how far the sticks lean, how high
// the top masses are above the surface, and how large the gaps between the sticks at one surface point are.
#pragma once
#include "harness/record/row.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

struct Shape {
  /// Median, smallest and largest angle between a stick and the surface normal at its base, in degrees.
  double lean_median = 0, lean_least = 0, lean_most = 0;
  /// Smallest height of a top mass above the tangent plane of the surface at the stick's base, in fur
  /// lengths. The value is negative if the mass has moved through the surface.
  double height_least = 0;
  /// Median and largest gap, in fur lengths. The gap at a surface point is the largest distance between the
  /// tops of two sticks at this point. Both are 0 if no point has several sticks.
  double gap_median = 0, gap_most = 0;
  std::size_t gap_points = 0;  ///< number of surface points with several sticks
};

/// Computes the shape. For each stick, `offset` holds the position of the top relative to the base, in R.
Shape shape_of(const SpringNetwork& topology, const std::vector<glm::vec3>& offset);

/// Adds the metrics `gap_median` and `gap_most` to the row, if any surface point has several sticks.
void describe_gap(const Shape& shape, Row& row);

}  // namespace pelage::springs
