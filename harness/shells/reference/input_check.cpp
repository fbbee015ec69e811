#include <fmt/format.h>

#include "harness/error.hpp"
#include "harness/shells/reference/reference.hpp"

namespace pelage::reference {
namespace {

void check(bool fits, const char* what) {
  if (!fits) throw InputError(fmt::format("a frame cannot be drawn: {}", what));
}

}  // namespace

void check_input(const FrameInput& input, const Options& options) {
  check(input.mesh != nullptr, "the input has no mesh");
  const Mesh& mesh = *input.mesh;
  const std::size_t faces = mesh.triangle.size(), copies = mesh.position.size(), points = mesh.welded;
  const std::size_t texels = std::size_t(input.scene.wetness.size) * std::size_t(input.scene.wetness.size);
  check(mesh.uv.size() == copies && mesh.weld.size() == copies,
        "the mesh needs one UV and one surface point per vertex");
  check(input.strands.normal.size() == faces && input.strands.anchor.size() == faces &&
            input.strands.phase.size() == faces,
        "the input needs one strand per triangle");
  const bool sticks = has_springs(input.scene.dynamics);
  check(!sticks || input.stick_normal.size() == points,
        "a mass-spring topology needs one normal per surface point");
  const bool on_copies = input.scene.dynamics.springs.vertices == "copies";
  check(
      options.sticks.empty() || options.sticks.size() == (parts(input.scene) ? 3 * faces
                                                          : on_copies        ? copies
                                                                             : points),
      "Options::sticks must have one entry per surface point (with dynamics.springs.vertices \"copies\", per vertex), or one per triangle corner if the topology is separable-sticks or separable-prisms");
  check(!sticks || !options.sticks.empty() || options.frames == 0,
        "Options::sticks must not be empty if a mass-spring topology is drawn after more than 0 frames");
  check(input.strands.row.size() == points + 1,
        "the matrix of strand weights must have one row per surface point");
  check(input.curl.u.size() == points && input.curl.v.size() == points && input.curl.mask_uv.size() == points,
        "the arrays of the curl's axes must have one entry per surface point");
  check(input.tangents.t.size() == copies && input.tangents.b.size() == copies,
        "the arrays of surface tangents must have one entry per vertex");
  check(input.scene.wetness.size > 0 && input.mask_surface.size() == texels,
        "the wetness mask needs one surface point per texel");
  check(input.scene.fur.layers >= 2 && input.fur.layers == input.scene.fur.layers && !input.fur.level.empty(),
        "the fur texture needs one slice per layer, and at least 2 layers");
  check(input.coat.size > 0, "the input has no coat texture");
  check(input.scene.fur.substeps >= 1, "fur.substeps must be at least 1");
  check(!options.eight_bit || input.scene.blend.order != "depth",
        "8 bits are rounded after every layer, but blend.order = \"depth\" does not draw by layers");
  check(input.camera.width > 0 && input.camera.height > 0 && input.camera.near > 0.0f,
        "the camera's size and near plane must be above 0");
}

}  // namespace pelage::reference
