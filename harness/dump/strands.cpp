// The datasets of a picture of strands. docs/dump.md, section Strands, lists them.

#include <fmt/format.h>

#include <array>

#include "harness/dump/datasets.hpp"
#include "harness/dump/dump.hpp"

namespace pelage {
namespace {

using namespace strands;

/// Returns one value per element: `value(element)`.
template <class T, class E, class F>
std::vector<T> column(const std::vector<E>& elements, const F& value) {
  std::vector<T> values;
  values.reserve(elements.size());
  for (const E& element : elements) values.push_back(value(element));
  return values;
}

void write_keys(Hdf5File& file, const std::vector<KeyStrand>& keys) {
  const auto write = [&](const char* name, glm::vec3 KeyStrand::*vector, const char* units,
                         const char* what) {
    const auto values = column<glm::vec3>(keys, [&](const KeyStrand& key) { return key.*vector; });
    file.write(name, {keys.size(), 3}, dump::flat<float>(values), units, what);
  };
  write("key/root", &KeyStrand::root, "R", "root of each key strand, in the object's frame");
  write("key/normal", &KeyStrand::normal, "1", "normal n of the skin at the root");
  write("key/first", &KeyStrand::first, "1", "direction u of the first segment");
  write("key/second", &KeyStrand::second, "1", "direction w of the second segment");
  write("key/rest", &KeyStrand::rest, "1", "direction d at rest");
}

void write_drawn_strands(Hdf5File& file, const std::vector<KeyedStrand>& strands) {
  const std::size_t count = strands.size();
  const auto keys = column<std::array<std::uint32_t, 3>>(strands, [](const auto& s) { return s.key; });
  file.write("strand/key", {count, 3}, dump::flat<std::uint32_t>(keys), "1",
             "indices of the three key strands around each strand");
  const auto weights = column<glm::vec2>(strands, [](const auto& s) { return s.weight; });
  file.write("strand/weight", {count, 2}, dump::flat<float>(weights), "1",
             "barycentric weights s and t of the second and of the third key strand");
  const auto colours = column<glm::vec3>(
      strands, [](const auto& s) { return glm::vec3(s.colour[0], s.colour[1], s.colour[2]) / 255.0f; });
  file.write("strand/colour", {count, 3}, dump::flat<float>(colours), "1", "colour c, gamma-encoded RGB");
  const auto layers = column<std::uint32_t>(strands, [](const auto& s) { return s.layer; });
  file.write("strand/layer", {count}, std::span<const std::uint32_t>(layers), "1",
             "number of the fur layer of each strand");
  const auto scalar = [&](const char* name, float KeyedStrand::*value, const char* units, const char* what) {
    const auto values = column<float>(strands, [&](const auto& s) { return s.*value; });
    file.write(name, {count}, std::span<const float>(values), units, what);
  };
  scalar("strand/length", &KeyedStrand::length, "R", "length L of each strand");
  scalar("strand/width", &KeyedStrand::width, "R", "width at the root");
  scalar("strand/response", &KeyedStrand::response, "1", "factor of the movement away from d");
  scalar("strand/twist", &KeyedStrand::twist, "degrees", "rotation about n");
  scalar("strand/curvature", &KeyedStrand::curvature, "degrees", "rotation of the second segment");
}

void write_curves(Hdf5File& file, const StrandFrame& frame) {
  const std::size_t count = frame.curves.size();
  const auto points = column<std::array<glm::vec3, 3>>(frame.curves, [](const auto& c) { return c.point; });
  file.write("curve/point", {count, 3, 3}, dump::flat<float>(points), "R",
             "control points root, joint and tip of each strand, in the object's frame");
  const auto normals = column<glm::vec3>(frame.curves, [](const auto& c) { return c.normal; });
  file.write("curve/normal", {count, 3}, dump::flat<float>(normals), "1", "normal of the skin at the root");
  const auto keys = column<std::uint32_t>(frame.order, [](const Entry& e) { return e.key; });
  file.write("order/key", {keys.size()}, std::span<const std::uint32_t>(keys), "1",
             "sort keys of the strands in the picture, from front to back");
  const auto numbers = column<std::uint32_t>(frame.order, [](const Entry& e) { return e.strand; });
  file.write("order/strand", {numbers.size()}, std::span<const std::uint32_t>(numbers), "1",
             "indices of these strands");
}

void write_look(Hdf5File& file, const StrandInput& input) {
  file.write("order/depth", {2}, std::array{input.range.nearest, input.range.per_depth}, "R, 1/R",
             "nearest and per_depth of the depth steps");
  std::vector<glm::vec3> fills;
  for (const FillLight& fill : input.look.fills) fills.insert(fills.end(), {fill.direction, fill.colour});
  file.write("light/fill", {input.look.fills.size(), 2, 3}, dump::flat<float>(fills), "1",
             "direction towards each fill light, of any length, and its colour");
  std::vector<std::uint32_t> layers;
  for (const LayerLook& layer : input.look.layers)
    for (const int value : {layer.rank, layer.first_frame, layer.frames})
      layers.push_back(std::uint32_t(value));
  file.write("light/layer", {input.look.layers.size(), 3}, std::span<const std::uint32_t>(layers), "1",
             "rank of each fur layer in the sort keys, its first film frame, and its number of film frames, "
             "which is 1 "
             "without a film strip");
  std::vector<std::uint8_t> film;
  for (const FilmFrame& film_frame : input.look.film)
    for (const FilmSample& sample : film_frame)
      film.insert(film.end(), {sample.luminance, sample.gloss, sample.opacity});
  file.write("light/film", {input.look.film.size(), std::size(FilmFrame{}), 3},
             std::span<const std::uint8_t>(film), "1",
             "frames of the film strip: luminance and gloss (128 means 1), opacity (255 means 1)");
}

void write_skin(Hdf5File& file, const SkinSurface& skin, bool deforms) {
  const std::size_t count = skin.position.size();
  if (deforms)
    file.write("skin/position", {count, 3}, dump::flat<float>(skin.position), "R",
               "position of each vertex in the frame of the picture, in place of that at rest");
  file.write("skin/normal", {count, 3}, dump::flat<float>(skin.normal), "1",
             "normal of the skin at each vertex");
  file.write("skin/colour", {count, 3}, dump::flat<float>(skin.colour), "1",
             "colour of the skin at each vertex, gamma-encoded RGB");
}

}  // namespace

void dump::write_strand_frame(Hdf5File& file, const StrandInput& input, const StrandFrame& frame) {
  write_keys(file, frame.keys);
  write_drawn_strands(file, input.fur.strands);
  write_curves(file, frame);
  write_look(file, input);
  if (frame.skin) write_skin(file, *frame.skin, !input.mesh->frames.empty());
  write_camera(file, input.camera);
}

}  // namespace pelage
