// Procedural shapes.
#pragma once
#include "harness/mesh/surface.hpp"

namespace pelage {

/// A torus around the y axis with major radius 1. It has `around` x `across` quads of two triangles each. The
/// UV map is periodic: u goes around the axis, v around the tube, both in [0,1].
Surface make_torus(int around, int across, double minor_radius);

/// The unit square in the plane y = 0 with the normal +y. It has `quads` x `quads` quads of four triangles
/// that meet in the quad's centre. UV is (x, -z).
Surface make_square(int quads);

/// A pear around the y axis: a closed implicit surface of revolution of height 1.9, without UV map. Each of
/// the 20 triangles of an icosahedron is split into four triangles `halvings` times; after each split the
/// points are projected onto the surface. The result is deterministic. CGAL's mesher for implicit surfaces is
/// not used, because its result depends on memory addresses.
Surface make_pear(int halvings);

}  // namespace pelage
