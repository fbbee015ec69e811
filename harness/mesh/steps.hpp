// The steps from a soup of polygons to a surface with a UV map, by CGAL. Each takes and gives a value; what
// it did is added to the surface's notes.
#pragma once
#include <cstdint>

#include "harness/mesh/soup.hpp"
#include "harness/mesh/surface.hpp"

namespace pelage {

/// An oriented manifold of triangles in one piece: coincident points welded, degenerate faces dropped, faces
/// turned, borders stitched, non-manifold points split, the largest piece kept, holes filled (with `fill_all`
/// every one; else those narrower than a tenth of the mesh). Throws InputError when nothing usable is left.
Surface repair(const Soup& soup, bool fill_all, const std::string& name);

/// For soups with a UV map of their own: coincident points welded, polygons split into triangles, faces
/// without three different points dropped; nothing else, so that the map stays what it was.
Surface weld(const Soup& soup, const std::string& name);

/// The watertight skin of a surface that cuts through itself (Portaneri et al. 2022, CGAL's alpha wrap).
Surface wrap(const Surface& surface);

/// Exactly `faces` triangles: Loop subdivision while there are too few, then edge collapses (Lindstrom and
/// Turk 1998) that never turn a face over; a closed mesh has an even count, so an odd one drops the face that
/// lies lowest along `up`. Throws InputError when the count cannot be reached.
Surface with_faces(const Surface& surface, std::uint32_t faces, glm::dvec3 up, const std::string& name);

}  // namespace pelage
