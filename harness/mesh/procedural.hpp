// Shapes that need no file.
#pragma once
#include "harness/mesh/surface.hpp"

namespace pelage {

/// A torus about the y axis, major radius 1, of `around` x `across` quads split in two; periodic UV: u around
/// the axis, v around the tube, each in [0,1].
Surface make_torus(int around, int across, double minor_radius);

/// The unit square in the plane y = 0 facing +y, of `quads` x `quads` quads split in four at their centres;
/// UV is the square itself.
Surface make_square(int quads);

/// A pear about the y axis: an implicit surface of revolution, meshed by CGAL at about the edge length `edge`
/// (the pear is 2 high), closed, without UV.
Surface make_pear(double edge);

}  // namespace pelage
