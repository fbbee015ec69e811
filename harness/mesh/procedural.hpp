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

/// A pear about the y axis: an implicit surface of revolution, 2 high, closed, without UV; an icosahedron
/// whose 20 triangles are cut in four `halvings` times and drawn onto it. The same bits every time, which
/// CGAL's own mesher of implicit surfaces does not give: it inserts points in the order of addresses.
Surface make_pear(int halvings);

}  // namespace pelage
