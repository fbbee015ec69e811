// Strands at rest as ray-cast cones (harness/strands/raycast).
#include "harness/error.hpp"
#include "harness/strands/reference/drawing.hpp"
#include "harness/system/backend_parts.hpp"
#include "harness/system/strands/backends.hpp"

namespace pelage::strands {
namespace {

class Raycast : public FromRest<StrandInput> {
 public:
  cl::FrameTiming frame() override { return still(); }
  void advance(int) override {}
  Picture read() override { return picture_; }
  void dump(Hdf5File& file, const Scene& scene) override {
    const std::vector<KeyStrand>& keys = input_->fur.keys;
    strands::dump(file, *input_, scene, {keys, reference_curves(*input_, keys), {}, {}});
  }
  std::string title() const override { return "strands-raycast"; }

 private:
  void draw() override { picture_ = raycast_strands(*input_).picture; }

  Picture picture_;
};

}  // namespace

void refuse_frames(const Mesh& mesh) {
  if (!mesh.frames.empty())
    throw InputError("mesh.frames: a ray-cast picture shows the strands at rest; give 1");
}

RaycastResult raycast_strands(const StrandInput& input) {
  refuse_frames(*input.mesh);
  const std::vector<DrawnStrand> all_curves = reference_curves(input, input.fur.keys);
  std::vector<DrawnStrand> curves;
  std::vector<std::uint32_t> number;
  for (const Entry& entry :
       reference::drawing_order(input.camera, input.range, all_curves, input.look.back_facing)) {
    curves.push_back(all_curves[entry.strand]);
    number.push_back(entry.strand);
  }
  const Look& look = input.look;
  const std::optional<reference::ShadowMap> shadow = reference::shadow_map_of(look, all_curves);
  RaycastScene cast;
  cast.camera = input.camera;
  cast.background = look.background;
  cast.radius = [&](std::uint32_t strand, float t) {
    return float(reference::half_width(look, curves[strand], double(t)));
  };
  cast.strand_paint = [&](std::uint32_t strand, float t) -> Paint {
    const DrawnStrand& drawn = curves[strand];
    return {glm::vec3(reference::strand_colour(input.camera, look, shadow, drawn, number[strand], double(t))),
            float(reference::alpha_of(look, drawn, number[strand], double(t)))};
  };
  std::vector<glm::dvec3> skin_colour;
  if (input.skin) {
    skin_colour = reference::skin_colours(look, *input.skin, shadow ? &*shadow : nullptr);
    cast.skin = input.mesh;
    cast.skin_paint = [&](std::uint32_t triangle, glm::vec2 weight) -> Paint {
      const glm::uvec3 t = input.mesh->triangle[triangle];
      const double s = double(weight.x), u = double(weight.y);
      return {glm::vec3((1 - s - u) * skin_colour[t.x] + s * skin_colour[t.y] + u * skin_colour[t.z]), 1};
    };
  }
  return raycast(cast, curves, rays);
}

std::unique_ptr<Backend> open_raycast(const BackendOptions&, const Scene&) {
  return std::make_unique<Raycast>();
}

}  // namespace pelage::strands
