#include "harness/strands/opencl/drawer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "harness/error.hpp"

namespace pelage::strands {
namespace {

constexpr std::size_t slice = 16;
constexpr int most_chunks = 65536;

int lanes_of(const cl::Device& device, int wanted) {
  if (wanted != 0 && wanted != 1 && wanted != 16)
    throw InputError(fmt::format("lanes: {}; it must be 0, 1 or 16", wanted));
  return wanted != 0 ? wanted : device.info().lanes;
}

int chunks_of(const cl::Device& device, int wanted) {
  if (wanted < 0 || wanted > most_chunks)
    throw InputError(fmt::format("chunks: {}; give 1 to {}, or 0 for the default", wanted, most_chunks));
  if (wanted > 0) return wanted;
  return device.info().cpu ? 16 : 1024;
}

bool is_group(const cl::Device& device, Drawing mapping) {
  return mapping == Drawing::standard ? !device.info().cpu : mapping == Drawing::group;
}

int tile_of(const cl::Device& device, const Camera& camera, bool group, int wanted) {
  if (wanted != 0 && wanted != 16 && wanted != 32 && wanted != 64 && wanted != 128)
    throw InputError(fmt::format("tile: {} pixels; it must be 16, 32, 64 or 128", wanted));
  if (group && wanted > 16)
    throw InputError(fmt::format("tile: {} pixels; the mapping for GPUs needs 16", wanted));
  if (wanted != 0) return wanted;
  if (group) return 16;
  // A strand is processed once per tile that it touches, so large tiles need less work. Small tiles are
  // distributed more evenly over many cores.
  const long large = long((camera.width + 127) / 128) * ((camera.height + 127) / 128);
  return large >= 8L * device.info().compute_units ? 128 : 64;
}

/// The exponent if it is an integer from 1 to 1024, else 0.
int whole_exponent(float exponent) {
  const bool whole = exponent >= 1 && exponent <= 1024 && std::floor(exponent) == exponent;
  return whole ? int(exponent) : 0;
}

void copy(float* to, glm::vec3 v) {
  for (int i = 0; i < 3; ++i) to[i] = v[i];
}
void copy(float* to, glm::vec4 v) {
  for (int i = 0; i < 4; ++i) to[i] = v[i];
}

DrawParams params_of(const DrawingScene& scene, int tile) {
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
  p.whole_exponent = whole_exponent(look.exponent);
  copy(p.specular, look.specular);
  copy(p.background, look.background);
  const Irradiance fill = irradiance_of(look);
  for (int colour = 0; colour < 3; ++colour)
    for (int i = 0; i < 9; ++i) p.fill[9 * colour + i] = fill[std::size_t(i)][colour];
  copy(p.rim, look.rim);
  p.rim_exponent = look.rim_exponent;
  p.skin_shadow = look.skin_shadow;
  p.skin_shadow_height = look.skin_shadow_height;
  p.frames = std::max(1, int(look.film.size()));
  return p;
}

/// True if the look has more than a key light and ambient light.
bool has_lights(const Look& look) {
  return !look.fills.empty() || look.rim != glm::vec3(0) || look.skin_shadow != 0 || !look.film.empty();
}

/// The film strip in the kernels' layout. Without a film strip, the result has one frame of factors 1.
std::vector<std::int32_t> film_table(const Look& look) {
  std::vector<std::int32_t> table;
  const std::vector<FilmFrame> one(1);
  for (const FilmFrame& frame : look.film.empty() ? one : look.film)
    for (const FilmSample& sample : frame)
      table.push_back(sample.luminance | sample.gloss << 8 | sample.opacity << 16);
  return table;
}

std::string options_of(int lanes, int tile, const Look& look, const std::vector<KeyedStrand>& strands) {
  return fmt::format("-D LANES={} -D STRAND_TILE={} -D STRAND_LIGHTS={} -D STRAND_STYLES={}", lanes, tile,
                     int(has_lights(look)), int(has_styles(strands)));
}

}  // namespace

Drawer::Drawer(const cl::Queue& queue, const DrawingScene& scene, const std::vector<KeyedStrand>& strands,
               std::size_t keys, const DrawerOptions& options)
    : strands_(strands),
      group_(is_group(queue.device(), options.mapping)),
      tile_(tile_of(queue.device(), scene.camera, group_, options.tile)),
      lanes_(lanes_of(queue.device(), options.lanes)),
      sort_(queue.device(), options.runs),
      params_(params_of(scene, tile_)),
      key_program_(queue.device(), "strands/draw/keys.cl", options_of(lanes_, tile_, scene.look, strands)),
      bin_program_(queue.device(), "strands/draw/bins.cl", options_of(1, tile_, scene.look, strands)),
      draw_program_(queue.device(), group_ ? "strands/draw/group.cl" : "strands/draw/tile.cl",
                    options_of(group_ ? 1 : 16, tile_, scene.look, strands)),
      make_keys_(key_program_, "strand_keys"),
      count_(bin_program_, "strand_bin_count"),
      sum_(bin_program_, "strand_bin_sum"),
      start_(bin_program_, "strand_bin_start"),
      fill_(bin_program_, "strand_bin_fill"),
      draw_(draw_program_, group_ ? "strand_group" : "strand_tiles"),
      key_bits_(std::any_of(strands.begin(), strands.end(), [](const KeyedStrand& s) { return s.rank > 0; })
                    ? 32
                    : 24) {
  if (strands.empty()) throw InputError("strands: there are none; at least one is needed");
  const cl::Device& device = queue.device();
  const std::vector<float> table = keyed_columns(strands, keys);
  constants_ = cl::Buffer<float>(queue, std::span<const float>(table));
  keys_ = cl::Buffer<float>(device, (keys + slice - 1) / slice * slice * KEY_RECORD);
  const std::size_t padded = (strands.size() + slice - 1) / slice * slice;
  params_.strands = int(strands.size());
  params_.units = int(padded / std::size_t(lanes_));
  params_.runs = sort_.runs();
  params_.units_per_run = (params_.units + params_.runs - 1) / params_.runs;
  params_.capacity = params_.units_per_run * lanes_;
  params_.chunks = chunks_of(device, options.chunks);
  rows_ = cl::Buffer<float>(device, padded * STRAND_ROW);
  const std::vector<std::int32_t> film = film_table(scene.look);
  film_ = cl::Buffer<std::int32_t>(queue, std::span<const std::int32_t>(film));
  curves_ = cl::Buffer<float>(device, 1);
  blocks_ = cl::Buffer<std::uint64_t>(device, padded);
  pairs_ = cl::Buffer<cl::Pair>(device, std::size_t(params_.capacity) * std::size_t(params_.runs));
  live_ = cl::Buffer<std::int32_t>(device, std::size_t(params_.runs));
  const std::size_t tiles = std::size_t(params_.tiles_x) * std::size_t(params_.tiles_y);
  chunk_count_ = cl::Buffer<std::int32_t>(device, tiles * std::size_t(params_.chunks));
  length_ = cl::Buffer<std::int32_t>(device, tiles);
  list_start_ = cl::Buffer<std::int32_t>(device, tiles + 1);
  taken_ = cl::Buffer<std::int32_t>(device, 1);
  const std::vector<std::int32_t> unknown(tiles, 0);
  blank_ = cl::Buffer<std::int32_t>(queue, std::span<const std::int32_t>(unknown));
  image_ = cl::Buffer<glm::vec4>(device, std::size_t(params_.width) * std::size_t(params_.height));
}

void Drawer::enqueue_keys(const cl::Queue& queue, cl::PhaseEvents* events) {
  make_keys_.with(params_, constants_, keys_, rows_, blocks_, pairs_, live_, curves_);
  const std::size_t group = queue.device().info().cpu ? 1 : 64;
  const std::size_t items = (std::size_t(params_.runs) + group - 1) / group * group;
  cl::Event event = make_keys_.enqueue(queue, items, group);
  if (events) events->emplace_back("keys", std::move(event));
}

void Drawer::enqueue_bins(const cl::Queue& queue, cl::PhaseEvents* events) {
  const auto keep = [&](cl::Event event) {
    if (events) events->emplace_back("bin", std::move(event));
  };
  const auto chunks = std::size_t(params_.chunks);
  count_.with(params_, sort_.total(), blocks_, pairs_, chunk_count_);
  keep(count_.enqueue(queue, chunks, 1));
  sum_.with(params_, chunk_count_, length_);
  keep(sum_.enqueue(queue, length_.size()));
  start_.with(params_, length_, list_start_, taken_);
  keep(start_.enqueue(queue, 1));
  std::array<std::int32_t, 1> total{};
  list_start_.read(queue, total, length_.size());
  if (total[0] == std::numeric_limits<std::int32_t>::max())
    throw DeviceError(
        "the strand lists of the tiles would have 2^31 entries or more: use a smaller picture or fewer "
        "strands");
  listed_ = std::size_t(total[0]);
  if (list_.size() < listed_) {
    list_ = {};  // frees the memory before the larger buffers are allocated
    spot_ = {};
    list_ = cl::Buffer<std::int32_t>(queue.device(), listed_ + listed_ / 4);
    spot_ = cl::Buffer<std::uint16_t>(queue.device(), listed_ + listed_ / 4);
  }
  if (listed_ == 0 && list_.size() == 0) {
    list_ = cl::Buffer<std::int32_t>(queue.device(), 1);
    spot_ = cl::Buffer<std::uint16_t>(queue.device(), 1);
  }
  fill_.with(params_, sort_.total(), blocks_, pairs_, list_start_, chunk_count_, list_, spot_);
  keep(fill_.enqueue(queue, chunks, 1));
}

void Drawer::enqueue(const cl::Queue& queue, cl::PhaseEvents* events) {
  enqueue_keys(queue, events);
  std::vector<cl::Event> sorted;
  sort_.sort(queue, pairs_, live_, std::size_t(params_.capacity), key_bits_, &sorted);
  if (events)
    for (cl::Event& event : sorted) events->emplace_back("sort", std::move(event));
  enqueue_bins(queue, events);
  draw_.with(params_, rows_, film_, list_start_, list_, spot_, image_, taken_, blank_);
  // With Drawing::item, a work-item draws tiles until no tile is left.
  const std::size_t tiles = length_.size(), group = std::size_t(tile_) * std::size_t(tile_);
  const std::size_t items = std::min(tiles, 32 * std::size_t(queue.device().info().compute_units));
  cl::Event event = group_ ? draw_.enqueue(queue, tiles * group, group) : draw_.enqueue(queue, items, 1);
  if (events) events->emplace_back("raster", std::move(event));
}

Picture Drawer::read(const cl::Queue& queue) const {
  return {params_.width, params_.height, image_.read(queue)};
}

std::vector<Entry> Drawer::order(const cl::Queue& queue) const {
  const std::vector<std::int32_t> total = sort_.total().read(queue);
  std::vector<cl::Pair> pairs(std::size_t(total.front()));
  pairs_.read(queue, std::span<cl::Pair>(pairs));
  std::vector<Entry> order;
  order.reserve(pairs.size());
  for (const cl::Pair& pair : pairs) order.push_back({pair.key, pair.value});
  return order;
}

std::vector<DrawnStrand> Drawer::curves(const cl::Queue& queue) {
  curves_ = cl::Buffer<float>(queue.device(), blocks_.size() * CURVE_COLUMNS);
  params_.keep_curves = 1;
  enqueue_keys(queue, nullptr);
  params_.keep_curves = 0;
  const std::vector<float> table = curves_.read(queue);
  curves_ = cl::Buffer<float>(queue.device(), 1);
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
    d.rank = s.rank;
  }
  return drawn;
}

std::vector<const cl::Program*> Drawer::programs() const {
  return {&key_program_, &sort_.program(), &bin_program_, &draw_program_};
}

}  // namespace pelage::strands
