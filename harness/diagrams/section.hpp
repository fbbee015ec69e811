// Sections of the fur and curves of the papers' equations, as tables of numbers that the reference computes.
// docs/experiments.md describes the columns. harness/report/plots/section.py draws the tables.
#pragma once
#include <string>
#include <vector>

#include "harness/prepare/frame_input.hpp"

namespace pelage::diagrams {

struct Section {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  ///< one value per column
};

/// Returns the section as CSV, with nine significant digits.
std::string csv_of(const Section& section);

/// The factor f(h) of a clump's displacement (S Eq. 5) for clump.shape 0, .25, .5, .75 and 1, at the heights
/// of the scene's layers. Columns: w, h, f.
Section shape_section(const Scene& scene);

/// The strands of one clump in a vertical plane through its centre, with the scene's readings. The clump has
/// the radius wetness.radius and the wetness wetness.wetness; its centre has the UV 0. The strands stand
/// upright at equal distances, two radii to each side. Columns: strand, inside (1 in the clump, else 0),
/// layer (-1 for the root), h, f, root (UV), u (UV at which the strand is drawn on the layer), d (root - u:
/// the displacement of S Eq. 5), x (u in R, for `length_per_uv` R per unit of UV) and y (height over the
/// surface, R).
Section clump_section(const Scene& scene, double length_per_uv);

/// The curl of an upright strand (S Eq. 1 and 4) for the wetness 0, .5 and 1. Columns: rho, h, x, y (offset
/// by the curl along u and v, R) and z (height over the surface, R).
Section curl_section(const Scene& scene);

/// The layers of the fur above the cut of the mesh by the plane z = 0, after `frames` frames. A row is an end
/// of a cut triangle's segment on a layer. Columns: segment, end (0 or 1), layer (-1 for the base surface),
/// h, x and y (position, R). The points of a layer lie where the strands of the cut reach it, which may be in
/// front of the plane or behind it.
Section layer_section(const FrameInput& input, int frames);

}  // namespace pelage::diagrams
