// The shape of the fur in one state of a mass-spring topology: the lean of the sticks, and the gaps between
// the sticks of one surface point.
#pragma once
#include "harness/journal/row.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage::springs {

struct Shape {
  /// Angle between a stick and its normal, in degrees: median, smallest and largest over all sticks.
  double lean_median = 0, lean_least = 0, lean_most = 0;
  /// Smallest height of a top mass above the plane through the base of its stick, in fur lengths. It is
  /// negative if the top is on the other side of the surface.
  double height_least = 0;
  /// The gap of a surface point is the largest distance between the tops of two of its sticks, in fur
  /// lengths: median and largest over the points with several sticks. Both are 0 if no point has several
  /// sticks.
  double gap_median = 0, gap_most = 0;
  std::size_t gap_points = 0;  ///< number of surface points with several sticks
};

/// `offset` holds, for each stick, the position of the top relative to the base, in R.
Shape shape_of(const SpringNetwork& topology, const std::vector<glm::vec3>& offset);

/// Adds the metrics `gap_median` and `gap_most`, unless no surface point has several sticks.
void describe_gap(const Shape& shape, Row& row);

}  // namespace pelage::springs
