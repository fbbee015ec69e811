#include "harness/strands/groom/fur.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <numeric>
#include <tuple>

#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/mesh/disk_cache.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/prepare/coat.hpp"
#include "harness/prepare/random.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/strands/groom/roots.hpp"
#include "harness/strands/groom/steps.hpp"

namespace pelage::strands {
namespace {

// Independent sequences of Random.
constexpr std::uint32_t length_stream = 71, colour_stream = 72, curvature_stream = 73, twist_stream = 74;
constexpr double least_size = 1e-6;  // least length and width of a strand, R

std::uint8_t byte_of(double value) {
  return std::uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

Picture picture_of(const std::filesystem::path& path, const std::string& key) {
  try {
    return read_picture(path);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", key, error.what()));
  }
}

/// Reads a film strip: a picture with 8 columns, from the root at the left to the tip at the right, and one
/// row per frame. Red is the luminance and green the gloss, where 128/255 means 1. Blue is the transparency.
/// Throws InputError if the picture cannot be read or has another size. `key` is the scene key in messages.
std::vector<FilmFrame> read_film(const std::filesystem::path& path, const std::string& key) {
  constexpr int columns = int(std::tuple_size_v<FilmFrame>), most_rows = 256;
  const Picture picture = picture_of(path, key);
  if (picture.width != columns || picture.height > most_rows)
    throw InputError(fmt::format("{}: {}: has {} x {} pixels; a film strip has {} columns and 1 to {} rows",
                                 key, path.string(), picture.width, picture.height, columns, most_rows));
  std::vector<FilmFrame> frames;
  for (int y = 0; y < picture.height; ++y) {
    FilmFrame frame;
    for (int x = 0; x < columns; ++x) {
      const glm::vec4 c = picture.at(x, y);
      frame[std::size_t(x)] = {byte_of(double(c.x)), byte_of(double(c.y)),
                               std::uint8_t(255 - byte_of(double(c.z)))};
    }
    frames.push_back(frame);
  }
  return frames;
}

/// Layers with equal seeds have different roots.
std::uint32_t seed_of(const StrandLayerScene& layer, std::size_t number) {
  return layer.seed + std::uint32_t(number) * 0x9e3779b9u;
}

/// The random values of a strand. They depend only on the layer's seed and on the strand's number in the
/// list of roots.
class Strands {
 public:
  Strands(const Mesh& mesh, const LayerMaps& maps, const CoatTexture& coat, std::uint32_t seed)
      : mesh_(mesh),
        maps_(maps),
        coat_(coat),
        lengths_(seed, length_stream),
        colours_(seed, colour_stream),
        curvatures_(seed, curvature_stream),
        twists_(seed, twist_stream) {}

  KeyedStrand at(const Root& root, std::size_t number, const std::vector<std::uint32_t>& keys) const {
    const StrandLayerScene& layer = maps_.layer;
    const glm::uvec3 corners = mesh_.triangle[root.face];
    const glm::dvec2 uv = uv_of(mesh_, root);
    const auto around = [&](float mean, float spread, const Random& random) {
      return double(mean) + double(spread) * random.symmetric(number);
    };
    KeyedStrand s;
    for (int k = 0; k < 3; ++k) s.key[std::size_t(k)] = keys[mesh_.weld[corners[k]]];
    s.weight = root.weight;
    const double length = double(layer.length) * around(1, layer.length_spread, lengths_);
    s.length = float(std::max(length * maps_.length.at(uv), least_size));
    s.width = float(std::max(double(layer.width) * maps_.width.at(uv), least_size));
    s.response = float(double(layer.response) * maps_.response.at(uv));
    const double twist = around(layer.twist, layer.twist_spread, twists_) * maps_.twist.sign_at(uv);
    const double curvature =
        around(layer.curvature, layer.curvature_spread, curvatures_) * maps_.curvature.sign_at(uv);
    s.twist = float(twist);
    s.curvature = float(std::clamp(curvature, -180.0, 180.0));
    const glm::dvec3 colour =
        coat_colour(coat_, uv) * glm::dvec3(layer.colour) * around(1, layer.colour_spread, colours_);
    for (int c = 0; c < 3; ++c) s.colour[std::size_t(c)] = byte_of(colour[c]);
    return s;
  }

 private:
  const Mesh& mesh_;
  const LayerMaps& maps_;
  const CoatTexture& coat_;
  Random lengths_, colours_, curvatures_, twists_;
};

void include(LayerBounds& bounds, glm::vec3 point) {
  bounds.low = glm::min(bounds.low, point);
  bounds.high = glm::max(bounds.high, point);
}

/// Returns the bounds of the strands from number `first` on.
LayerBounds bounds_of(const Fur& fur, std::size_t first) {
  const float most = std::numeric_limits<float>::max();
  LayerBounds bounds{glm::vec3(most), glm::vec3(-most)};
  for (std::size_t i = first; i < fur.strands.size(); ++i) {
    const KeyedStrand& s = fur.strands[i];
    const auto mean = [&](glm::vec3 KeyStrand::*v) {
      const glm::vec3 a = fur.keys[s.key[0]].*v, b = fur.keys[s.key[1]].*v, c = fur.keys[s.key[2]].*v;
      return a + s.weight.x * (b - a) + s.weight.y * (c - a);
    };
    const glm::vec3 root = mean(&KeyStrand::root), rest = mean(&KeyStrand::rest);
    include(bounds, root);
    if (glm::length(rest) > 0) include(bounds, root + s.length * glm::normalize(rest));
  }
  return bounds;
}

/// The arguments of prefix_order() for all strands.
struct Places {
  std::vector<float> place;
  std::vector<std::uint32_t> near;
};

/// Sorts the strands of all layers in the order of prefix_order().
void sort_strands(const Places& places, Fur& fur) {
  std::vector<KeyedStrand> sorted;
  sorted.reserve(fur.strands.size());
  for (const std::uint32_t i : prefix_order(places.place, places.near)) sorted.push_back(fur.strands[i]);
  fur.strands = std::move(sorted);
}

void add_layer(const Mesh& mesh, const Skin& skin, const LayerMaps& maps, const CoatTexture& coat,
               std::size_t number, float first_segment, Fur& fur, Places& places) {
  const std::uint32_t seed = seed_of(maps.layer, number);
  maps.require_place(mesh);
  const std::vector<Root> roots = scatter_roots(
      mesh, [&](const Root& root) { return maps.density(mesh, root); }, std::size_t(maps.layer.count), seed,
      maps.bare(mesh));
  KeyStrands keys = key_strands(mesh, skin, maps, roots);
  const auto first_key = std::uint32_t(fur.keys.size());
  for (std::uint32_t& key : keys.index) key += first_key;
  fur.keys.insert(fur.keys.end(), keys.keys.begin(), keys.keys.end());
  fur.chains.insert(fur.chains.end(), keys.chains.begin(), keys.chains.end());
  fur.points.insert(fur.points.end(), keys.point.begin(), keys.point.end());
  const std::size_t first = fur.strands.size();
  const Strands values(mesh, maps, coat, seed);
  const auto first_face = std::uint32_t(number * mesh.triangle.size());
  std::vector<KeyedStrand> strands;
  strands.reserve(roots.size());
  for (std::size_t i = 0; i < roots.size(); ++i) {
    strands.push_back(values.at(roots[i], i, keys.index));
    strands.back().layer = std::uint8_t(number);
    places.place.push_back(float((double(i) + 0.5) / double(roots.size())));
    places.near.push_back(first_face + roots[i].face);
  }
  pull_into_locks(strands, fur.keys, {std::size_t(maps.layer.locks), maps.layer.lock_pull, first_segment});
  fur.strands.insert(fur.strands.end(), strands.begin(), strands.end());
  fur.bounds.push_back(bounds_of(fur, first));
}

}  // namespace

void add_film(const std::vector<StrandLayerScene>& layers, Fur& fur) {
  const bool any = std::ranges::any_of(layers, [](const StrandLayerScene& l) { return !l.film.empty(); });
  int plain = -1;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::string key = fmt::format("strands.layer[{}].film", i + 1);
    LayerLook look{int(i), int(fur.film.size()), 1};
    if (!layers[i].film.empty()) {
      const std::vector<FilmFrame> frames = read_film(layers[i].film, key);
      look.frames = int(frames.size());
      fur.film.insert(fur.film.end(), frames.begin(), frames.end());
    } else if (any) {
      if (plain < 0) {
        plain = int(fur.film.size());
        fur.film.emplace_back();
      }
      look.first_frame = plain;
    } else {
      look.first_frame = 0;
    }
    if (fur.film.size() > std::size_t(most_frames))
      throw InputError(fmt::format("{}: {}: the film strips of all layers have more than {} frames in total",
                                   key, layers[i].film.string(), most_frames));
    fur.layers.push_back(look);
  }
}

Fur grow_layers(const Mesh& mesh, const StrandsScene& strands, const CoatTexture& coat) {
  const std::vector<StrandLayerScene>& layers = strands.layers;
  if (coat.size < 1 || coat.texel.size() < std::size_t(coat.size) * std::size_t(coat.size))
    throw InputError("coat of the strands: the texture has no texels");
  Fur fur;
  Places places;
  const Skin skin = weld(mesh);
  for (std::size_t i = 0; i < layers.size(); ++i)
    add_layer(mesh, skin, LayerMaps(layers[i], fmt::format("strands.layer[{}]", i + 1)), coat, i,
              strands.chain.first_segment, fur, places);
  sort_strands(places, fur);
  add_film(layers, fur);
  return fur;
}

void set_chains(Fur& fur, const ChainScene& chain) {
  for (Chain& each : fur.chains) {
    each.stiffness_first *= chain.stiffness;
    each.stiffness_second *= chain.stiffness_joint;
    each.limit_first = std::clamp(each.limit_first * chain.limit, 1.0f, 180.0f);
    each.limit_second = std::clamp(each.limit_second * chain.limit_joint, 1.0f, 180.0f);
  }
}

Fur grow(const Mesh& mesh, const StrandsScene& strands, const CoatTexture& coat) {
  Fur fur = grow_layers(mesh, strands, coat);
  set_chains(fur, strands.chain);
  return fur;
}

std::vector<std::uint8_t> layer_ranks(std::span<const LayerBounds> bounds, const Camera& camera,
                                      std::span<const float> biases, std::span<const int> offsets) {
  const std::size_t count = bounds.size();
  if (count > 256 || biases.size() != count || offsets.size() != count)
    throw InputError(
        "order of the fur layers: give one bias and one offset per layer, for at most 256 layers");
  const glm::dvec4 row(camera.row_w);
  const auto depth = [&](std::size_t i) {
    const glm::dvec3 centre = 0.5 * (glm::dvec3(bounds[i].low) + glm::dvec3(bounds[i].high));
    return row.x * centre.x + row.y * centre.y + row.z * centre.z + row.w + double(biases[i]);
  };
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return depth(a) < depth(b); });
  std::vector<std::tuple<long, int, std::size_t>> places;  // place, offset, layer
  for (std::size_t k = 0; k < count; ++k)
    places.emplace_back(long(k) + offsets[order[k]], offsets[order[k]], order[k]);
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) {
    return std::tie(std::get<0>(a), std::get<1>(a)) < std::tie(std::get<0>(b), std::get<1>(b));
  });
  std::vector<std::uint8_t> ranks(count);
  for (std::size_t k = 0; k < count; ++k) ranks[std::get<2>(places[k])] = std::uint8_t(k);
  return ranks;
}

namespace {

constexpr std::size_t least_block = 16, block_part = 16;

}  // namespace

std::vector<std::uint32_t> prefix_order(std::span<const float> place, std::span<const std::uint32_t> near) {
  std::vector<std::uint32_t> order(place.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return place[a] < place[b]; });
  for (std::size_t first = 0; first < order.size();) {
    const std::size_t last = std::min(order.size(), first + std::max(least_block, first / block_part));
    std::stable_sort(order.begin() + std::ptrdiff_t(first), order.begin() + std::ptrdiff_t(last),
                     [&](std::uint32_t a, std::uint32_t b) { return near[a] < near[b]; });
    first = last;
  }
  return order;
}

namespace {

/// The hash of everything that grow_layers() reads.
std::string key_of(const Mesh& mesh, const StrandsScene& strands, const CoatTexture& coat) {
  Scene scene;
  scene.strands.layers = strands.layers;
  scene.strands.chain.first_segment = strands.chain.first_segment;
  for (StrandLayerScene& layer : scene.strands.layers) {
    layer.order_bias = StrandLayerScene{}.order_bias;
    layer.order_offset = StrandLayerScene{}.order_offset;
    layer.opacity = layer.taper = layer.gloss = layer.exponent = layer.rim_exponent = layer.skin_shadow = 1;
    layer.rim = glm::vec3(1);
  }
  return Hash()
      .text(mesh.hash)
      .text(scene_hash(scene))
      .number(std::uint64_t(coat.size))
      .values(coat.texel)
      .number(fur_recipe)
      .hex();
}

}  // namespace

Fur kept_fur(const Mesh& mesh, const StrandsScene& strands, const CoatTexture& coat) {
  if (mesh.hash.empty()) return grow(mesh, strands, coat);
  const auto lists = [](const auto& store, auto& fur) {
    return store(fur.keys) && store(fur.chains) && store(fur.points) && store(fur.strands) &&
           store(fur.bounds) && store(fur.layers) && store(fur.film);
  };
  Fur fur = cached<Fur>(cache_folder() / "fur" / key_of(mesh, strands, coat), "pelage fur 1\n",
                        std::uintmax_t(512) << 20, lists, [&] { return grow_layers(mesh, strands, coat); });
  set_chains(fur, strands.chain);
  return fur;
}

}  // namespace pelage::strands
