// Draws the base surface and then the layers from the innermost to the outermost (docs/shells.md, sections 5
// to 7, and section 4 of S).
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "harness/parallel.hpp"
#include "harness/prepare/fur_texture.hpp"
#include "harness/shells/reference/coverage.hpp"
#include "harness/shells/reference/layers.hpp"
#include "harness/shells/reference/light.hpp"
#include "harness/shells/reference/mask.hpp"
#include "harness/shells/reference/reference.hpp"
#include "harness/shells/reference/shading.hpp"
#include "harness/shells/reference/textures.hpp"
#include "harness/shells/reference/tile.hpp"
#include "harness/shells/reference/vector.hpp"

namespace pelage::reference {
namespace {

/// A pixel that a triangle covers: the pixel's coordinates, the triangle's 1/w there, and the
/// perspective-correct weight of each of the triangle's corners.
struct Sample {
  int x, y;
  double inverse_w;
  glm::dvec3 share;
};

class Painter {
 public:
  Painter(const FrameInput& input, const Options& options, const Mask& mask, const Geometry& geometry)
      : input_(input), options_(options), mask_(mask), geometry_(geometry), point_(geometry.slots()) {}

  /// Projects the vertices of layer n to the screen, except those that no drawn face uses. n = -1 is the base
  /// surface.
  void move_to(int n) {
    layer_ = n;
    for_each_index(point_.size(), 1024, [&](std::size_t s) {
      if (geometry_.wanted(s)) point_[s] = project(input_.camera, geometry_.position(s, n));
    });
  }

  /// Finds the faces that face away from the eye, after move_to(-1). The sum of the signed areas of the
  /// clipped and snapped base decides.
  void find_facing(const std::vector<char>& wanted) {
    away_.assign(wanted.size(), 0);
    for (std::uint32_t face = 0; face < wanted.size(); ++face) {
      if (!wanted[face]) continue;
      const std::vector<ClippedVertex> polygon = clip(
          {point_[geometry_.slot(face, 0)], point_[geometry_.slot(face, 1)], point_[geometry_.slot(face, 2)]},
          double(input_.camera.near));
      std::int64_t area = 0;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Snapped p = snap(polygon[i].point), q = snap(polygon[(i + 1) % polygon.size()].point);
        area += p.x * q.y - q.x * p.y;
      }
      away_[face] = (area > 0) != (options_.mutant == Mutant::facing_swapped);
    }
  }

  /// Draws only the faces that face away from the eye, or only the others; all faces without a value.
  void only_away(std::optional<bool> away) { only_away_ = away; }

  void draw(Tile& tile) const {
    const bool reversed = layer_ >= 0 && options_.mutant == Mutant::triangles_reversed;
    for (std::size_t i = 0; i < tile.faces.size(); ++i)
      draw_face(tile, tile.faces[reversed ? tile.faces.size() - 1 - i : i]);
    if (options_.eight_bit)
      for (glm::dvec4& pixel : tile.colour)
        for (int c = 0; c < 4; ++c)
          pixel[c] = std::floor(std::clamp(pixel[c], 0.0, 1.0) * 255.0 + 0.5) / 255.0;
  }

 private:
  void draw_face(Tile& tile, std::uint32_t face) const {
    if (only_away_ && *only_away_ != (away_[face] != 0)) return;
    const std::array<ClipPoint, 3> corners{point_[geometry_.slot(face, 0)], point_[geometry_.slot(face, 1)],
                                           point_[geometry_.slot(face, 2)]};
    const auto inside = [&](const ClipPoint& p) {
      return p.w >= double(input_.camera.near) && std::abs(p.x) <= guard * p.w &&
             std::abs(p.y) <= guard * p.w;
    };
    if (inside(corners[0]) && inside(corners[1]) && inside(corners[2])) {
      draw_part(tile, face,
                {ClippedVertex{corners[0], {1, 0, 0}}, {corners[1], {0, 1, 0}}, {corners[2], {0, 0, 1}}});
      return;
    }
    const std::vector<ClippedVertex> polygon = clip(corners, double(input_.camera.near));
    for (std::size_t i = 2; i < polygon.size(); ++i)
      draw_part(tile, face, {polygon[0], polygon[i - 1], polygon[i]});
  }

  void draw_part(Tile& tile, std::uint32_t face, const std::array<ClippedVertex, 3>& part) const {
    const Raster raster({snap(part[0].point), snap(part[1].point), snap(part[2].point)}, input_.camera.width,
                        input_.camera.height);
    if (raster.empty()) return;
    if (layer_ >= 0 && options_.mutant == Mutant::front_faces_culled && raster.faces_eye()) return;
    const Window box = raster.box(tile.window);
    for (int y = box.y; y < box.y + box.height; ++y)
      for (int x = box.x; x < box.x + box.width; ++x) {
        const Edges edges = raster.edges(x, y);
        if (!edges.covered) continue;
        const double sum = double(edges.value[0]) + double(edges.value[1]) + double(edges.value[2]);
        Sample sample{x, y, 0.0, glm::dvec3(0.0)};
        for (std::size_t k = 0; k < 3; ++k) {
          const double share = double(edges.value[k]) / sum / part[k].point.w;
          sample.inverse_w += share;
          sample.share += share * part[k].corners;
        }
        sample.share /= sample.inverse_w;
        if (layer_ < 0)
          draw_base(tile, face, sample);
        else
          draw_fur(tile, face, sample);
      }
  }

  /// Interpolates an attribute over the triangle `face`. of_slot(s) returns the attribute's value at the
  /// corner that has the index s in `geometry_`.
  template <class Value>
  auto interpolated(std::uint32_t face, const Sample& sample, const Value& of_slot) const {
    return sample.share[0] * of_slot(geometry_.slot(face, 0)) +
           sample.share[1] * of_slot(geometry_.slot(face, 1)) +
           sample.share[2] * of_slot(geometry_.slot(face, 2));
  }

  glm::dvec2 uv(std::uint32_t face, const Sample& sample) const {
    const glm::dvec2 at = interpolated(
        face, sample, [&](std::size_t s) { return glm::dvec2(input_.mesh->uv[geometry_.vertex(s)]); });
    return options_.mutant == Mutant::uv_swapped ? glm::dvec2(at.y, at.x) : at;
  }

  Bend bend(std::uint32_t face, const Sample& sample) const {
    return {interpolated(face, sample, [&](std::size_t s) { return geometry_.bend(s).a; }),
            interpolated(face, sample, [&](std::size_t s) { return geometry_.bend(s).b; })};
  }

  glm::dvec3 tangent(std::uint32_t face, const Sample& sample) const {
    return interpolated(face, sample,
                        [&](std::size_t s) { return glm::dvec3(input_.tangents.t[geometry_.vertex(s)]); });
  }

  glm::dvec3 bitangent(std::uint32_t face, const Sample& sample) const {
    return interpolated(face, sample,
                        [&](std::size_t s) { return glm::dvec3(input_.tangents.b[geometry_.vertex(s)]); });
  }

  /// Returns the displacement by the curl on layer `to` minus that on layer `from`. With curl.turns_map, the
  /// axes and the factor of the turns are interpolated, and the factor is rounded like that of a vertex.
  glm::dvec3 curl_step(std::uint32_t face, const Sample& sample, int from, int to) const {
    if (!input_.style.curl_turns.empty()) {
      const double share =
          interpolated(face, sample, [&](std::size_t s) { return geometry_.turns_share(s); });
      const glm::dvec3 u =
          interpolated(face, sample, [&](std::size_t s) { return geometry_.curl_axes(s).u; });
      const glm::dvec3 v =
          interpolated(face, sample, [&](std::size_t s) { return geometry_.curl_axes(s).v; });
      return curl_change(input_.scene, share, {u, v}, from, to);
    }
    return interpolated(face, sample, [&](std::size_t s) {
      return geometry_.curl_offset(s, to) - geometry_.curl_offset(s, from);
    });
  }

  /// Samples the fur texture for a fragment with the texture coordinates `where`. With
  /// scene.fur.substeps = 1, the function takes one sample. With k > 1 sub-steps, the function takes k
  /// samples between the fragment's layer and the layer below. At the layer below, the view ray meets a
  /// different strand than at the fragment's layer. shift() returns the vector, in UV, from the root of the
  /// fragment's strand to the root of this different strand. clump.delta_d is the clump's displacement at the
  /// fragment's layer minus the clump's displacement at the layer below, in UV. From the fragment's layer to
  /// the layer below, the texture coordinates therefore change by shift() - clump.delta_d.
  template <class Shift>
  FurSample look(const glm::dvec2& where, const Displacement& clump, double level, const Shift& shift) const {
    const auto sampled = [&](const glm::dvec2& uv) {
      return sample_fur(input_.fur, uv * glm::dvec2(input_.fur_scale), layer_, level,
                        coverage_power(input_.scene.fur));
    };
    const int count = input_.scene.fur.substeps;
    if (count == 1) return sampled(where + clump.d);
    const glm::dvec2 below = shift() - clump.delta_d;
    std::vector<FurSample> samples;
    samples.reserve(std::size_t(count));
    for (int i = 0; i < count; ++i)
      samples.push_back(sampled(where + clump.d + double(i) / double(count) * below));
    return combined(samples);
  }

  /// Returns the part of the first light that reaches a fragment whose strand has the root `root`. pull(m)
  /// is that of LightRay.
  template <class Pull>
  double through(std::uint32_t face, const Sample& sample, const glm::dvec2& root, double level,
                 const Pull& pull) const {
    const Bend strand = bend(face, sample);
    return light_through(input_,
                         {layer_, root, unit(strand.a), tangent(face, sample), bitangent(face, sample), level,
                          [&](int m) {
                            return rise(input_, strand, layer_, m, options_.mutant) +
                                   curl_step(face, sample, layer_, m);
                          },
                          pull});
  }

  /// Returns E, the unit direction from the eye through the pixel's centre.
  glm::dvec3 view(const Sample& sample) const {
    const Camera& camera = input_.camera;
    const double x = double(sample.x) + 0.5 - 0.5 * double(camera.width);
    const double y = double(sample.y) + 0.5 - 0.5 * double(camera.height);
    return unit(glm::dvec3(camera.ray) + x * glm::dvec3(camera.ray_dx) + y * glm::dvec3(camera.ray_dy));
  }

  void draw_base(Tile& tile, std::uint32_t face, const Sample& sample) const {
    const std::size_t at = tile.at(sample.x, sample.y);
    if (!(sample.inverse_w > tile.base[at])) return;
    tile.base[at] = sample.inverse_w;
    const glm::dvec2 where = uv(face, sample);
    const glm::dvec3 eye = view(sample);
    const ShadingScene& shading = input_.scene.shading;
    const glm::dvec3 outwards = unit(bend(face, sample).a), normal = lit_normal(shading, outwards, eye);
    // No fur shadows the back of the surface. The back therefore has the shadow factor of the fur's tips, at
    // the height h = 1.
    const bool back = shows_back(shading, outwards, eye);
    Fragment fragment{sample_coat(input_.coat, where) * glm::dvec3(input_.scene.coat.skin),
                      normal,
                      normal,
                      eye,
                      back ? 1.0 : 0.0,
                      mask_.wetness_at(where, input_.scene.clump.cells)};
    if (!back)
      fragment.through = through(face, sample, where, level_of_detail(sample, outwards, eye),
                                 [](int) { return glm::dvec2(0.0); });
    tile.colour[at] = glm::dvec4(skin_colour(input_.scene.shading, fragment), 1.0);
  }

  void draw_fur(Tile& tile, std::uint32_t face, const Sample& sample) const {
    const std::size_t at = tile.at(sample.x, sample.y);
    if (!(sample.inverse_w >= tile.base[at])) return;
    const Scene& scene = input_.scene;
    const glm::dvec2 where = uv(face, sample);
    const Displacement clump = clump_displacement(input_, mask_, where, layer_, options_.mutant);
    if (clump.discarded) return;
    const Bend strand = bend(face, sample);
    const glm::dvec3 normal = unit(strand.a), eye = view(sample);
    const glm::dvec3 step = chord(input_, strand, layer_, options_.mutant);
    const double level = level_of_detail(sample, normal, eye) + std::log2(clump.stretch);
    FurSample fur = look(where, clump, level, [&] {
      const glm::dvec3 delta = root_shift(step + curl_step(face, sample, layer_ - 1, layer_), normal, eye);
      return uv_shares(delta, tangent(face, sample), bitangent(face, sample));
    });
    if (scene.fur.shade == 0.0f) fur.shade = 1.0;  // which the bytes of the texture cannot store
    fur.coverage *= shown(clump, sample, normal, eye) * double(scene.fur.density) *
                    sample_density(input_.style.density, where + clump.d);
    const double h = layer_height(layer_, scene.fur.layers, options_.mutant);
    const double film = cover_with_film(fur, clump.film, film_coverage(scene, h));
    if (!(fur.coverage > 0.0)) return;

    const glm::dvec3 along =
        strand_direction(scene, step, tangent(face, sample), bitangent(face, sample), normal, drift(clump));
    const Fragment fragment{sample_coat(input_.coat, where + clump.d) * fur.shade,
                            along,
                            lit_normal(scene.shading, normal, eye),
                            options_.mutant == Mutant::eye_reversed ? -eye : eye,
                            h,
                            clump.wetness,
                            film,
                            clump.film_wetness,
                            double(scene.soaked.gloss),
                            through(face, sample, where + clump.d, level, [&](int m) {
                              return clump_displacement(input_, mask_, where, m, options_.mutant).d - clump.d;
                            })};
    const FurFragment drawn{sample.inverse_w, fur_colour(scene.shading, fragment), fur.coverage};
    if (by_depth(scene.blend))
      tile.waiting[at].push_back(drawn);
    else
      blend_over(drawn, tile.colour[at]);
  }

  /// Returns the clump's displacement for W Eq. 4.
  Displacement drift(Displacement clump) const {
    if (options_.mutant == Mutant::tangent_reversed) {
      clump.moved = -clump.moved;
      clump.delta_d = -clump.delta_d;
    }
    return clump;
  }

  /// Returns the part of a fragment's coverage that clump.cells "consistent" leaves: for each clump around
  /// the strand's root, it falls from 1 to 0 while the strand is misplaced by up to the footprint of a pixel.
  /// It also falls within half a mask texel of a disc's border, across which the displacement jumps.
  double shown(const Displacement& clump, const Sample& sample, const glm::dvec3& normal,
               const glm::dvec3& eye) const {
    if (clump.placements.empty()) return 1.0;
    const double footprint = std::exp2(level_of_detail(sample, normal, eye));
    const auto in_footprints = [&](const glm::dvec2& d) {
      return std::min(1.0,
                      glm::length(d * glm::dvec2(input_.fur_scale) * double(input_.fur.size)) / footprint);
    };
    double sum = 0.0;
    for (const Placement& place : clump.placements)
      sum += place.weight * (1.0 - in_footprints(place.misplaced));
    return sum * std::max(1.0 - in_footprints(clump.border_d),
                          std::min(1.0, 2.0 * double(mask_.size) * clump.border_distance));
  }

  /// Returns the mip level: log2 of a pixel's footprint on the surface, in texels of level 0, plus
  /// fur.lod_bias.
  double level_of_detail(const Sample& sample, const glm::dvec3& normal, const glm::dvec3& eye) const {
    const FurScene& fur = input_.scene.fur;
    const double pixel = double(input_.camera.pixel) / sample.inverse_w;
    return std::log2(double(fur.tile) * double(input_.fur.size) * pixel /
                     std::max(std::abs(glm::dot(normal, eye)), 0.1)) +
           double(fur.lod_bias);
  }

  const FrameInput& input_;
  const Options& options_;
  const Mask& mask_;
  const Geometry& geometry_;
  int layer_ = -1;
  std::vector<char> away_;  ///< for each face: 1 if it faces away from the eye
  std::optional<bool> only_away_;
  std::vector<ClipPoint> point_;  ///< projected position of each vertex or triangle corner on layer layer_
};

/// Returns the sweeps over the layers in the order in which they are drawn: each draws the faces that face
/// away from the eye (true), the others (false), or all faces (no value).
std::vector<std::optional<bool>> sweeps(const BlendScene& scene) {
  if (scene.faces == "front") return {false};
  if (scene.faces == "back-then-front" && !by_depth(scene)) return {true, false};
  return {std::nullopt};
}

}  // namespace

Picture render(const FrameInput& input, const Options& options) {
  check_input(input, options);
  const Camera& camera = input.camera;
  const glm::vec4 background(input.scene.image.background, 0.0f);
  Picture picture{camera.width, camera.height, {}};
  picture.pixel.assign(std::size_t(camera.width) * std::size_t(camera.height), background);

  std::vector<Tile> tiles;
  for (const Window& window : split(options.windows, camera)) tiles.push_back({window, {}, {}, {}, {}});
  for_each_index(tiles.size(), [&](std::size_t i) {
    Tile& tile = tiles[i];
    tile.faces = visible_faces(input, tile.window);
    const std::size_t pixels = std::size_t(tile.window.width) * std::size_t(tile.window.height);
    tile.base.assign(pixels, 0.0);
    tile.colour.assign(pixels, glm::dvec4(background));
    if (by_depth(input.scene.blend)) tile.waiting.resize(pixels);
  });
  std::vector<char> wanted(input.mesh->triangle.size(), 0);
  for (const Tile& tile : tiles)
    for (const std::uint32_t face : tile.faces) wanted[face] = 1;

  const Mask mask = wetness_mask(input, options.frames, options.mutant);
  const Geometry geometry(input, mask, options.frames, wanted, options.mutant, options.sticks);
  Painter painter(input, options, mask, geometry);
  const int layers = input.scene.fur.layers;
  const auto draw_layer = [&](int n) {
    if (options.mutant == Mutant::layer_missing && n == layers / 2) return;
    painter.move_to(n);
    for_each_index(tiles.size(), [&](std::size_t i) { painter.draw(tiles[i]); });
  };
  draw_layer(-1);
  for (const std::optional<bool> away : sweeps(input.scene.blend)) {
    if (away) {
      painter.move_to(-1);
      painter.find_facing(wanted);
    }
    painter.only_away(away);
    for (int n = 0; n < layers; ++n) draw_layer(n);
  }
  for_each_index(tiles.size(), [&](std::size_t i) { blend_by_depth(tiles[i]); });

  for (const Tile& tile : tiles)
    for (int y = tile.window.y; y < tile.window.y + tile.window.height; ++y)
      for (int x = tile.window.x; x < tile.window.x + tile.window.width; ++x)
        picture.at(x, y) = glm::vec4(tile.colour[tile.at(x, y)]);
  return picture;
}

}  // namespace pelage::reference
