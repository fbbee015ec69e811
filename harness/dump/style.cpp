#include <array>

#include "harness/dump/datasets.hpp"

namespace pelage::dump {

void write_style(Hdf5File& file, const FrameInput& input) {
  const Style& style = input.style;
  const auto write = [&](const char* name, const std::vector<float>& values, const char* what) {
    if (!values.empty()) file.write(name, {values.size()}, std::span<const float>(values), "1", what);
  };
  write("style/length", style.length, "factor of fur.length of each strand");
  write("style/comb", style.comb, "factor of fur.comb at each surface point");
  write("style/radius", style.curl_radius, "factor of curl.radius at each surface point");
  write("style/turns", style.curl_turns, "factor of curl.turns at each surface point");
  const Style::Density& density = style.density;
  if (!density.value.empty())
    file.write("style/density", {std::size_t(density.height), std::size_t(density.width)},
               std::span<const float>(density.value), "1",
               "factor of fur.density at the centres of the map's pixels, top row (v = 1) first");
  const DistanceField* field = input.contact_field.get();
  if (!field) return;
  file.write("contact/field",
             {std::size_t(field->nodes.z), std::size_t(field->nodes.y), std::size_t(field->nodes.x)},
             std::span<const float>(field->distance), "1",
             "distances from the mesh among the colliders, divided by contact.mesh_scale, negative inside; "
             "the axes of the array are z, y and x");
  file.write("contact/grid", {4}, std::array{field->origin.x, field->origin.y, field->origin.z, field->cell},
             "1",
             "position of the field's first node relative to the mesh, and the distance of adjacent nodes, "
             "both divided by contact.mesh_scale");
}

}  // namespace pelage::dump
