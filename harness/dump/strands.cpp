// The datasets of a picture of strands. docs/dump.md, section Strands, lists them.

#include <array>

#include "harness/dump/dump.hpp"

namespace pelage {
namespace {

using namespace strands;

void write_strand_columns(Hdf5File& file, const StrandInput& input, const std::vector<KeyStrand>& keys) {
  const std::vector<KeyedStrand>& strands = input.fur.strands;
  const auto key = [&](const char* name, auto value, const char* units, const char* what) {
    file.write(name, dump::column(keys, value), units, what);
  };
  const auto strand = [&](const char* name, auto value, const char* units, const char* what) {
    file.write(name, dump::column(strands, value), units, what);
  };
  key("key/root", &KeyStrand::root, "R", "root of each key strand, in the object's frame");
  key("key/normal", &KeyStrand::normal, "1", "normal n of the skin at the root of each key strand");
  key("key/first", &KeyStrand::first, "1", "direction u of the first segment of each key strand");
  key("key/second", &KeyStrand::second, "1", "direction w of the second segment of each key strand");
  key("key/rest", &KeyStrand::rest, "1", "direction d of each key strand at rest");
  strand("strand/key", &KeyedStrand::key, "1", "indices of the three key strands around each strand");
  strand("strand/weight", &KeyedStrand::weight, "1",
         "barycentric weights s and t of the second and of the third key strand");
  strand(
      "strand/colour",
      [](const auto& s) { return glm::vec3(s.colour[0], s.colour[1], s.colour[2]) / 255.0f; }, "1",
      "colour c of each strand, gamma-encoded RGB");
  strand(
      "strand/layer", [](const auto& s) { return std::uint32_t(s.layer); }, "1",
      "number of the fur layer of each strand, from 0");
  strand("strand/length", &KeyedStrand::length, "R", "length of each strand");
  strand("strand/width", &KeyedStrand::width, "R",
         "width of each strand at the root, before the level of detail widens the strands");
  strand("strand/response", &KeyedStrand::response, "1",
         "response, the factor of a strand's movement away from d");
  strand("strand/twist", &KeyedStrand::twist, "degrees", "angle by which twist rotates u and w about n");
  strand("strand/curvature", &KeyedStrand::curvature, "degrees",
         "angle by which curvature rotates w about n x u");
}

void write_shapes(Hdf5File& file, const std::vector<StrandShape>& shapes) {
  file.write("strand/part", dump::column(shapes, [](const auto& s) { return glm::vec2(s.from, s.to); }), "1",
             "start and end of each curve on its strand, from 0 (root) to 1 (tip)");
  file.write("strand/width_end", dump::column(shapes, &StrandShape::width_end), "1",
             "width of each curve at its end divided by strand/width");
  file.write("strand/offset", dump::column(shapes, &StrandShape::offset), "R",
             "control points of each curve at rest, from the points of the straight strand");
}

void write_curves(Hdf5File& file, const StrandFrame& frame) {
  using dump::column;
  file.write("curve/point", column(frame.curves, &DrawnStrand::point), "R",
             "control points root, joint and tip of each strand, in the object's frame");
  file.write("curve/normal", column(frame.curves, &DrawnStrand::normal), "1",
             "normal of the skin at the root of each strand");
  file.write("order/key", column(frame.order, &Entry::key), "1",
             "sort keys of the strands in the picture, from front to back");
  file.write("order/strand", column(frame.order, &Entry::strand), "1",
             "indices of the strands in the picture, in the order of order/key");
}

void write_look(Hdf5File& file, const StrandInput& input) {
  using dump::column;
  file.write("order/depth", std::array{input.range.nearest, input.range.per_depth}, "R, 1/R",
             "values that define the depth steps: nearest and per_depth (docs/strands.md, section Order)");
  file.write("light/fill",
             column(input.look.fills,
                    [](const auto& f) {
                      return std::array{f.direction, f.colour};
                    }),
             "1", "direction towards each fill light, of any length, and the light's colour");
  const auto layer = [](const LayerLook& l) {
    return std::array{std::uint32_t(l.rank), std::uint32_t(l.first_frame), std::uint32_t(l.frames)};
  };
  file.write(
      "light/layer", column(input.look.layers, layer), "1",
      "rank of each fur layer in the sort keys, index of its first frame in light/film, and number of its frames, which is 1 without a film strip");
  const auto look = [](const LayerLook& l) {
    return std::array{l.opacity, l.taper, l.gloss, l.exponent, l.rim_exponent, l.skin_shadow};
  };
  file.write("light/layer_look", column(input.look.layers, look), "1",
             "factors of each fur layer: opacity, taper, gloss, exponent, rim_exponent and skin_shadow");
  file.write("light/layer_rim", column(input.look.layers, &LayerLook::rim), "1",
             "factors of the rim light of each fur layer: red, green and blue");
  std::vector<std::array<std::uint8_t, 3>> film;
  for (const FilmFrame& frame : input.look.film)
    for (const FilmSample& sample : frame) film.push_back({sample.luminance, sample.gloss, sample.opacity});
  file.write(
      "light/film", {input.look.film.size(), std::size(FilmFrame{})}, film, "1",
      "frames of the film strips, each with 8 samples from root to tip: luminance and gloss (128 means 1), opacity (255 means 1)");
}

void write_skin(Hdf5File& file, const SkinSurface& skin, bool deforms) {
  if (deforms)
    file.write("skin/position", skin.position, "R",
               "position of each vertex in the frame of the picture, in place of that at rest");
  file.write("skin/normal", skin.normal, "1", "normal of the skin at each vertex");
  file.write("skin/colour", skin.colour, "1", "colour of the skin at each vertex, gamma-encoded RGB");
}

}  // namespace

void dump::write_strand_frame(Hdf5File& file, const StrandInput& input, const StrandFrame& frame) {
  write_strand_columns(file, input, frame.keys);
  if (input.shapes) write_shapes(file, *input.shapes);
  write_curves(file, frame);
  write_look(file, input);
  if (frame.skin) write_skin(file, *frame.skin, !input.mesh->frames.empty());
  write_camera(file, input.camera);
}

}  // namespace pelage
