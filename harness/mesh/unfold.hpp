// A UV map of one chart.
#pragma once
#include <string>

#include "harness/mesh/cut.hpp"

namespace pelage {

/// Cuts the surface into a disk as planned and lays it flat as rigidly as possible (Liu et al. 2008, lambda
/// 1000, 10 iterations); where that fails, by mean-value coordinates on a circle. Throws InputError where
/// that fails too.
Surface unfold(const Surface& surface, const CutPlan& plan, const std::string& name);

/// Chooses a plan by trying: limbs are cut into one after another, farthest first, and a cut stays when the
/// map gets better by it (less squeezed and stretched, without overlapping itself). A hundred maps and more
/// are made, so `proxy` should be a coarse version (some 6000 faces) of the surface that is meant: a plan
/// holds points, which carry over.
CutPlan plan_cut(const Surface& proxy, const std::string& name);

}  // namespace pelage
