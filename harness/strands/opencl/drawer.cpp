#include "harness/strands/opencl/drawer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>
#include <span>

#include "harness/error.hpp"
#include "harness/strands/drawing/detail.hpp"
#include "harness/strands/drawing/film_table.hpp"

namespace pelage::strands {
namespace {

using cl::copy;

constexpr std::size_t slice = 16;
constexpr int most_chunks = 65536;

int chunks_of(const cl::Device& device, int wanted) {
  if (wanted < 0 || wanted > most_chunks)
    throw InputError(fmt::format("chunks: {}; give 1 to {}, or 0 for the default", wanted, most_chunks));
  if (wanted > 0) return wanted;
  return device.info().cpu ? 16 : 1024;
}

DrawParams params_of(const DrawingScene& scene, int tile, int chunks) {
  const Camera& c = scene.camera;
  const Look& look = scene.look;
  check(look);
  if (!(scene.first_segment > 0 && scene.first_segment < 1))
    throw InputError(fmt::format("first segment: {}; it must be above 0 and below 1", scene.first_segment));
  DrawParams p{};
  p.width = c.width;
  p.height = c.height;
  p.tiles_x = (c.width + tile - 1) / tile;
  p.tiles_y = (c.height + tile - 1) / tile;
  p.block_side = block_side(tile);
  copy(p.row_x, c.row_x);
  copy(p.row_y, c.row_y);
  copy(p.row_w, c.row_w);
  copy(p.eye, c.eye);
  p.near_depth = c.near;
  p.pixel = c.pixel;
  p.half_per_width = 0.5f / c.pixel;
  p.nearest = scene.range.nearest;
  p.per_depth = scene.range.per_depth;
  p.first_segment = scene.first_segment;
  p.slope = (1 - scene.first_segment) / scene.first_segment;
  p.segments = look.segments;
  p.strand_segments = look.strand_segments;
  p.own_segments = look.own_segments ? 1 : 0;
  p.back_facing = look.back_facing == BackFacing::removed ? BACK_REMOVED
                  : look.back_facing == BackFacing::last  ? BACK_LAST
                                                          : BACK_DRAWN;
  p.taper = look.taper;
  p.opacity = look.opacity;
  const glm::dvec3 light = glm::normalize(glm::dvec3(look.light));
  const double pixel = c.pixel;
  copy(p.light,
       glm::vec3(glm::dot(glm::dvec3(c.row_x), light) * pixel, glm::dot(glm::dvec3(c.row_y), light) * pixel,
                 glm::dot(glm::dvec3(c.row_w), light)));
  p.intensity = look.intensity;
  p.ambient = look.ambient;
  p.exponent = look.exponent;
  const bool own_exponents = std::ranges::any_of(look.layers, [](const auto& l) { return l.exponent != 1; });
  p.whole_exponent = own_exponents ? 0 : cl::whole_exponent(look.exponent);
  copy(p.specular, look.specular);
  copy(p.background, look.background);
  const Irradiance fill = irradiance_of(look);
  for (int colour = 0; colour < 3; ++colour)
    for (int i = 0; i < 9; ++i) p.fill[9 * colour + i] = fill[std::size_t(i)][colour];
  copy(p.rim, look.rim);
  p.rim_exponent = look.rim_exponent;
  p.skin_shadow = look.skin_shadow;
  p.skin_shadow_height = look.skin_shadow_height;
  if (look.shadow.reading != Shadow::none) set_map_rows(p, c, look);
  p.chunks = chunks;
  return p;
}

/// The frames of film_table() in the kernels' layout: FILM_RECORD integers each.
std::vector<std::int32_t> film_words(const Look& look) {
  std::vector<std::int32_t> words;
  for (const LayerFrame& frame : film_table(look).frames) {
    for (const FilmSample& sample : frame.film)
      words.push_back(sample.luminance | sample.gloss << 8 | sample.opacity << 16);
    for (const float factor : frame.factors()) words.push_back(std::bit_cast<std::int32_t>(factor));
  }
  return words;
}

/// Number of bits that the sort keys of the strands use.
int key_bits_of(const Look& look, const std::vector<KeyedStrand>& strands,
                const std::vector<LayerLook>& layers) {
  if (look.back_facing == BackFacing::last) return 32;
  const bool ranks = std::any_of(strands.begin(), strands.end(),
                                 [&](const KeyedStrand& s) { return layers[s.layer].rank > 0; });
  return ranks ? 32 : 24;
}

/// The fur layers in the kernels' layout: LAYER_RECORD integers each.
std::vector<std::int32_t> layer_table(const std::vector<LayerLook>& layers) {
  std::vector<std::int32_t> table;
  for (const LayerLook& layer : layers) {
    table.insert(table.end(), {layer.rank, layer.first_frame, layer.frames});
    for (const float factor : {layer.rim.x, layer.rim.y, layer.rim.z, layer.rim_exponent, 0.0f})
      table.push_back(std::bit_cast<std::int32_t>(factor));
  }
  return table;
}

bool same_size(const Camera& a, const Camera& b) {
  return a.width == b.width && a.height == b.height;
}

PictureKinds kinds_of(const DrawingScene& scene, const std::vector<KeyedStrand>& strands) {
  const Look& look = scene.look;
  return {has_lights(look), has_styles(strands), has_layer_looks(look), look.shadow.reading,
          scene.shapes != nullptr};
}

}  // namespace

Drawer::Drawer(const cl::Queue& queue, const DrawingScene& scene, const std::vector<KeyedStrand>& strands,
               std::size_t keys, const DrawerOptions& options)
    : strands_(strands),
      scene_(scene),
      layers_(film_table(scene.look).layers),
      kinds_(kinds_of(scene, strands)),
      layout_(layout_of(queue.device().info(), scene.camera.width, scene.camera.height, options)),
      sort_(queue.device(), options.runs),
      params_(params_of(scene, layout_.tile, chunks_of(queue.device(), options.chunks))),
      key_bits_(key_bits_of(scene.look, strands_, layers_)) {
  if (strands.empty()) throw InputError("strands: there are none; at least one is needed");
  if (scene.shapes && scene.shapes->size() != strands.size())
    throw InputError(fmt::format("strands: {} shapes for {} strands", scene.shapes->size(), strands.size()));
  need_looks(scene.look, strands_);
  const cl::Device& device = queue.device();
  constants_ = cl::uploaded(queue, keyed_columns(strands, keys));
  shapes_ = scene.shapes ? cl::uploaded(queue, shape_columns(*scene.shapes)) : cl::Buffer<float>(device, 1);
  keys_ = cl::Buffer<float>(device, (keys + slice - 1) / slice * slice * KEY_RECORD);
  const std::size_t padded = (strands.size() + slice - 1) / slice * slice;
  params_.runs = sort_.runs();
  set_pruning(Look{});
  params_.capacity = params_.units_per_run * layout_.lanes;
  set_pruning(scene.look);
  pass_.emplace(queue, params_, picture_texts(kinds_, layout_, false, scene.skin != nullptr), layout_, padded,
                kinds_.shapes);
  film_ = cl::uploaded(queue, film_words(scene.look));
  layer_table_ = cl::Buffer<std::int32_t>(device, std::size_t(most_layers) * LAYER_RECORD);
  nothing_ = cl::Buffer<glm::vec4>(device, 1);
  if (scene.look.shadow.reading != Shadow::none)
    map_.emplace(queue, params_, light_view(scene.look), kinds_, layout_, padded);
  if (scene.skin) skin_.emplace(queue, params_, *scene.skin, layout_.lanes, skin_text(kinds_, layout_.lanes));
}

void Drawer::set_pruning(const Look& look) {
  const Pruning pruning = pruning_of(strands_.size(), look);
  params_.strands = pruning.drawn;
  params_.widen = pruning.widen;
  params_.per_fade = pruning.per_fade;
  // The constants of the strands have slices of 16 strands.
  const std::size_t padded = (std::size_t(pruning.drawn) + slice - 1) / slice * slice;
  params_.units = int(padded / std::size_t(layout_.lanes));
  params_.units_per_run = (params_.units + params_.runs - 1) / params_.runs;
}

bool Drawer::can_show(const DrawingScene& scene) const {
  check(scene.look);
  return same_size(scene.camera, scene_.camera) && film_words(scene.look) == film_words(scene_.look) &&
         kinds_of(scene, strands_) == kinds_ && scene.look.shadow.size == scene_.look.shadow.size &&
         scene.skin == scene_.skin && scene.shapes == scene_.shapes;
}

void Drawer::set_view(const DrawingScene& scene) {
  const Camera &old = scene_.camera, &camera = scene.camera;
  if (!same_size(camera, old))
    throw InputError(fmt::format("view: a picture of {}x{} pixels; the drawer was made for {}x{}",
                                 camera.width, camera.height, old.width, old.height));
  if (!can_show(scene))
    throw InputError(
        "view: another film strip, other kinds of light, another shadow or another skin need a new drawer");
  need_looks(scene.look, strands_);
  DrawParams p = params_of(scene, layout_.tile, params_.chunks);
  p.runs = params_.runs;
  p.capacity = params_.capacity;
  params_ = p;
  scene_ = scene;
  layers_ = film_table(scene.look).layers;
  layers_written_ = false;
  key_bits_ = key_bits_of(scene.look, strands_, layers_);
  set_pruning(scene.look);
}

void Drawer::write_layers(const cl::Queue& queue) {
  if (layers_written_) return;
  layer_table_.write(queue, layer_table(layers_));
  layers_written_ = true;
}

void Drawer::enqueue_keys(const cl::Queue& queue, cl::PhaseEvents* events) {
  write_layers(queue);
  pass_->make_keys(queue, params_, buffers(), "keys", events);
}

void Drawer::enqueue(const cl::Queue& queue, cl::PhaseEvents* events) {
  if (map_) {
    write_layers(queue);
    map_->enqueue(queue, params_, light_view(scene_.look), buffers(), events);
  }
  const cl::Buffer<glm::vec4>& map = map_ ? map_->texels() : nothing_;
  if (skin_) skin_->enqueue(queue, params_, map, events);
  enqueue_keys(queue, events);
  sort_.sort(queue, pass_->pairs(), pass_->live(), std::size_t(params_.capacity), key_bits_, events);
  pass_->draw(queue, params_, sort_.total(), film_, map, skin_ ? skin_->pixels() : nothing_, "bin", "raster",
              events);
}

Picture Drawer::read(const cl::Queue& queue) const {
  return {params_.width, params_.height, pass_->image().read(queue)};
}

std::vector<Entry> Drawer::order(const cl::Queue& queue) const {
  const std::vector<std::int32_t> total = sort_.total().read(queue);
  std::vector<cl::Pair> pairs(std::size_t(total.front()));
  pass_->pairs().read(queue, std::span<cl::Pair>(pairs));
  std::vector<Entry> order;
  order.reserve(pairs.size());
  for (const cl::Pair& pair : pairs) {
    if (params_.back_facing == BACK_LAST && pair.key == LAST_KEY) break;  // the strands behind are not drawn
    order.push_back({pair.key, pair.value});
  }
  return order;
}

std::vector<DrawnStrand> Drawer::curves(const cl::Queue& queue) {
  const std::size_t padded = (strands_.size() + slice - 1) / slice * slice;
  pass_->curves() = cl::Buffer<float>(queue.device(), padded * CURVE_COLUMNS);
  params_.keep_curves = 1;
  set_pruning(Look{});
  enqueue_keys(queue, nullptr);
  params_.keep_curves = 0;
  set_pruning(scene_.look);
  const std::vector<float> table = pass_->curves().read(queue);
  pass_->curves() = cl::Buffer<float>(queue.device(), 1);
  std::vector<DrawnStrand> drawn(strands_.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const auto vector = [&](int column) {
      const float* first = &table[(i / slice * CURVE_COLUMNS + std::size_t(column)) * slice + i % slice];
      return glm::vec3(first[0], first[slice], first[2 * slice]);
    };
    const KeyedStrand& s = strands_[i];
    DrawnStrand& d = drawn[i];
    d.point = {vector(CURVE_ROOT), vector(CURVE_JOINT), vector(CURVE_TIP)};
    d.normal = vector(CURVE_NORMAL);
    d.colour = glm::vec3(s.colour[0], s.colour[1], s.colour[2]) / 255.0f;
    d.width = s.width;
    d.layer = s.layer;
    d.rank = layers_[s.layer].rank;
  }
  if (scene_.shapes) set_parts(drawn, strands_, *scene_.shapes);
  return drawn;
}

std::vector<glm::vec4> Drawer::opacity_map(const cl::Queue& queue) const {
  return map_ ? map_->texels().read(queue) : std::vector<glm::vec4>();
}

void Drawer::deform_skin(const cl::Queue& queue, const SkinSurface& skin) {
  if (!skin_) throw InputError("skin of the strands: the picture has no skin that could deform");
  skin_->deform(queue, skin);
}

std::vector<const cl::Program*> Drawer::programs() const {
  std::vector<const cl::Program*> all = pass_->programs();
  for (const cl::Program* program : sort_.programs()) all.push_back(program);
  if (map_)
    for (const cl::Program* program : map_->programs()) all.push_back(program);
  if (skin_) all.push_back(&skin_->program());
  return all;
}

}  // namespace pelage::strands
