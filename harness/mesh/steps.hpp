// The steps from a polygon soup to a surface with a UV map, implemented with CGAL. Each step appends
// descriptions of its changes to Surface::notes.
#pragma once
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "harness/mesh/read/soup.hpp"
#include "harness/mesh/surface.hpp"

namespace pelage {

/// Sends the current stage of a long preparation to a callback, with the stage's completed fraction and the
/// seconds since the construction of the Stages object. Example: "cat.obj: computing the UV map, 40%, 12 s".
class Stages {
 public:
  using Say = std::function<void(const std::string&)>;

  /// No messages are sent during the first `silent_s` seconds after the construction. Messages with a
  /// completed fraction are at least 2.5 * silent_s seconds apart.
  Stages(Say say, std::string label, double silent_s)
      : say_(std::move(say)), label_(std::move(label)), silent_s_(silent_s) {}

  void begin(const std::string& stage) {
    stage_ = stage;
    const double now = seconds();
    if (now < silent_s_) return;
    say_(fmt::format("{}: {}, {:.0f} s", label_, stage_, now));
    told_ = now;
  }
  /// `fraction`: completed fraction of the stage, 0 to 1.
  void part(double fraction) {
    const double now = seconds();
    if (now < silent_s_ || now - told_ < 2.5 * silent_s_) return;
    say_(fmt::format("{}: {}, {:.0f}%, {:.0f} s", label_, stage_, 100 * fraction, now));
    told_ = now;
  }
  /// Returns a callback that takes the completed fraction of the stage and passes it to part().
  std::function<void(double)> parts() {
    return [this](double fraction) { part(fraction); };
  }

 private:
  using Clock = std::chrono::steady_clock;
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  Say say_;
  std::string label_, stage_;
  double silent_s_, told_ = 0;
  Clock::time_point start_ = Clock::now();
};

/// Options of repair() for holes and components.
struct RepairOptions {
  /// True: fill all holes; false: fill a hole only if the diagonal of its bounding box is at most 1/10 of the
  /// diagonal of the mesh's bounding box.
  bool fill_all;
  /// True: keep only the component with the most faces; false: keep all closed components, and each open
  /// component with at least 1% of the area of the largest component.
  bool largest_only;
};

/// Converts a soup to an oriented triangle manifold. It welds coincident points, drops degenerate faces,
/// orients faces consistently, stitches borders, splits non-manifold points, drops small components and fills
/// holes. `stages` receives the name of the current stage. Throws InputError if no face is left or too many
/// components remain.
Surface repair(const Soup& soup, const RepairOptions& options, const std::string& name, Stages& stages);

/// Converts a soup with its own UV map to a surface. It welds coincident points, splits polygons into
/// triangles, drops triangles without an area, and orients the others. It changes nothing else, so the UV map
/// is preserved. Throws InputError if no triangle is left, if some polygons have no UV, or if the UV map has
/// no area.
Surface weld(const Soup& soup, const std::string& name);

/// If the components of the soup have less than four polygons on average, joins points that are nearer than
/// 1e-6 of its size, and returns a note; "" if nothing was joined.
std::string weld_near(Soup& soup);

/// Divides a polygon, which need not be convex or plane, into triangles of its corners (CGAL's triangulation
/// of holes).
std::vector<std::array<std::size_t, 3>> triangles_of(const std::vector<glm::dvec3>& corner);

/// Orients neighbouring faces alike, and splits points where this is impossible. Each face keeps the UV of
/// its corners. Adds notes.
void orient(Surface& surface);

/// Returns a watertight hull of a surface that intersects itself (Portaneri et al. 2022, CGAL's alpha wrap).
Surface wrap(const Surface& surface);

/// Changes the number of triangles to exactly `faces`. First, Loop subdivision is repeated until there are at
/// least `faces` triangles. Then edge collapses (Lindstrom and Turk 1998) remove the surplus triangles. No
/// collapse flips a face. A closed mesh has an even number of triangles, so for an odd `faces` the lowest
/// face in the direction `up` is removed. `part` receives the completed fraction of the collapses. Throws
/// InputError if the count cannot be reached.
Surface with_faces(const Surface& surface, std::uint32_t faces, glm::dvec3 up, const std::string& name,
                   const std::function<void(double)>& part);

// Procedural shapes.

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

// Connected components of a surface. Each component has its own chart in the UV map.

/// Returns the component number of each triangle. Triangles that share a point belong to the same component.
/// Components are numbered from 0 in the order of their first triangles.
std::vector<std::uint32_t> components(const Surface& surface);

/// Orients the faces of every closed component outwards, and adds a message to Surface::notes if the
/// orientation of a face changes.
void turn_outwards(Surface& surface);

/// Returns one surface per component. These surfaces have no messages in Surface::notes and no UV map. The
/// order of triangles and points is preserved.
std::vector<Surface> split(const Surface& surface);

/// Packs the UV maps of the components `parts` side by side into the unit square, without overlap. Returns
/// `surface` with the packed UV map. `parts` is in the order in which split() returns the components. All
/// charts have the same ratio of UV area to surface area. For up to 163 charts, the margin around a chart is
/// 2/256 of the square's side, which is two texels of a wetness mask of 256 x 256 texels. For more charts,
/// the margin is smaller.
Surface packed(const Surface& surface, const std::vector<Surface>& parts);

}  // namespace pelage
