// The steps from a soup of polygons to a surface with a UV map, by CGAL. Each takes and gives a value; what
// it did is added to the surface's notes.
#pragma once
#include <cstdint>
#include <functional>

#include "harness/mesh/soup.hpp"
#include "harness/mesh/stages.hpp"
#include "harness/mesh/surface.hpp"

namespace pelage {

/// What a source's recipe does with holes and components.
struct RepairOptions {
  bool fill_all = false;     ///< every hole is filled; else those narrower than a tenth of the mesh
  bool largest_only = true;  ///< only the component of most faces is kept; else all that are closed or large
};

/// An oriented manifold of triangles: coincident points welded, degenerate faces dropped, faces turned,
/// borders stitched, non-manifold points split, scraps dropped, holes filled. Throws InputError when nothing
/// usable is left. `stages` is told the stage now in hand.
Surface repair(const Soup& soup, const RepairOptions& options, const std::string& name, Stages& stages);

/// For soups with a UV map of their own: coincident points welded, polygons split into triangles, faces
/// without three different points dropped; nothing else, so that the map stays what it was.
Surface weld(const Soup& soup, const std::string& name);

/// The watertight skin of a surface that cuts through itself (Portaneri et al. 2022, CGAL's alpha wrap).
Surface wrap(const Surface& surface);

/// Exactly `faces` triangles: Loop subdivision while there are too few, then edge collapses (Lindstrom and
/// Turk 1998) that never turn a face over; a closed mesh has an even count, so an odd one drops the face that
/// lies lowest along `up`. Throws InputError when the count cannot be reached.
/// `part` is told the fraction of the collapses that is done.
Surface with_faces(const Surface& surface, std::uint32_t faces, glm::dvec3 up, const std::string& name,
                   const std::function<void(double)>& part = {});

}  // namespace pelage
