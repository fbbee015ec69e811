#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "harness/error.hpp"
#include "harness/shells/opencl/group_bins.hpp"
#include "harness/shells/opencl/stages.hpp"

namespace pelage::shells {
namespace {

// Layers of which a tile decides together what it leaves out: deciding costs, and so does what need not be
// set up.
int default_group(int layers) {
  return std::max(4, (layers + 5) / 6);
}

// Tiles consist of blocks of 4 x 4 pixels, and coverage is exact up to 32 (edge_from in
// rasterize/coverage/coverage.clh).
int tile_side(const std::map<std::string, int>& tuning, const std::string& axis, int otherwise) {
  const int side = tuned(tuning, axis, otherwise);
  if (side < 4 || side > 32 || side % 4 != 0)
    throw InputError(fmt::format("tuning: {} is {}: a multiple of 4 from 4 to 32", axis, side));
  return side;
}

// A word of four bytes, the first one lowest.
std::int32_t word_of(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
  return static_cast<std::int32_t>(std::uint32_t(a) | std::uint32_t(b) << 8 | std::uint32_t(c) << 16 |
                                   std::uint32_t(d) << 24);
}

// Coverage and shade of (x, y), then of (x, y + 1), in one word; each row ends with its first texel again.
std::vector<std::int32_t> packed_fur(const FurTexture& fur) {
  std::size_t texels = 0;
  for (std::size_t l = 0; l < fur.level.size(); ++l)
    texels += fur.level[l].size() + fur.level[l].size() / std::size_t(fur.size >> l);
  std::vector<std::int32_t> words(texels);
  auto next = words.begin();
  const auto word = [](const auto& here, const auto& below) {
    return word_of(here[0], here[1], below[0], below[1]);
  };
  for (std::size_t l = 0; l < fur.level.size(); ++l) {
    const auto side = std::size_t(fur.size >> l);
    for (std::size_t n = 0; n < std::size_t(fur.layers); ++n) {
      const auto* slice = &fur.level[l][n * side * side];
      for (std::size_t y = 0; y < side; ++y) {
        const auto *here = slice + y * side, *below = slice + (y + 1) % side * side;
        for (std::size_t x = 0; x < side; ++x) *next++ = word(here[x], below[x]);
        *next++ = word(here[0], below[0]);
      }
    }
  }
  return words;
}

// Two words per texel, red and green of (x, y) and of (x, y + 1), then blue of both, with a border of a texel
// all around: the picture repeats.
std::vector<std::int32_t> packed_coat(const CoatTexture& coat) {
  const auto side = std::size_t(coat.size);
  std::vector<std::int32_t> words;
  words.reserve(2 * (side + 2) * (side + 2));
  for (std::size_t y = 0; y < side + 2; ++y) {
    const auto *here = &coat.texel[(y + side - 1) % side * side], *below = &coat.texel[y % side * side];
    for (std::size_t x = 0; x < side + 2; ++x) {
      const auto &t = here[(x + side - 1) % side], &u = below[(x + side - 1) % side];
      words.push_back(word_of(t[0], t[1], u[0], u[1]));
      words.push_back(word_of(t[2], 0, u[2], 0));
    }
  }
  return words;
}

template <class T>
cl::Buffer<T> upload(const cl::Queue& queue, const std::vector<T>& values) {
  return cl::Buffer<T>(queue, std::span<const T>(values));
}

constexpr std::int32_t triangles_per_chunk = 1024;

// The tile of the mapping "group" is a part of its kernels. A pixel walks its tile's whole list for every
// layer: the shorter the better.
std::map<std::string, int> tuning_of(const Mapping& mapping, std::map<std::string, int> tuning) {
  if (mapping.name == "group") tuning["TILE_W"] = tuning["TILE_H"] = group_tile;
  if (mapping.name == "pixel") tuning.insert({{"TILE_W", 8}, {"TILE_H", 8}});
  return tuning;
}

RasterParams tiled(RasterParams p, const std::map<std::string, int>& tuning, const cl::Device& device) {
  p.group = std::clamp(tuned(tuning, "GROUP", default_group(p.layers)), 1, p.layers);
  const int tile_w = tile_side(tuning, "TILE_W", TILE_W), tile_h = tile_side(tuning, "TILE_H", TILE_H);
  p.tiles_x = (p.width + tile_w - 1) / tile_w;
  p.tiles_y = (p.height + tile_h - 1) / tile_h;
  const int wanted = std::max(1, tuned(tuning, "CHUNKS", 4)) * int(device.info().compute_units);
  p.chunks = std::clamp((p.triangles + triangles_per_chunk - 1) / triangles_per_chunk, 1, wanted);
  p.every_layer = tuned(tuning, "REACH", 1) == 0 ? 1 : 0;
  p.chunk = ((p.triangles + p.chunks - 1) / p.chunks + 15) / 16 * 16;
  return p;
}

}  // namespace

Mapping mapping_of(const std::string& name, const cl::Device& device) {
  const std::string wanted = name.empty() ? default_mapping(device.info()) : name;
  if (wanted == "tile") return {wanted, "rasterize/tile/tile.cl", "tile_shells", device.info().lanes};
  if (wanted == "pixel") return {wanted, "rasterize/pixel/pixel.cl", "pixel_shells", 1};
  if (wanted == "group") return {wanted, "rasterize/workgroup/workgroup.cl", "group_shells", 1};
  throw InputError(fmt::format("mapping '{}': one of {}", name, fmt::join(mappings(), ", ")));
}

RasterStage::~RasterStage() = default;

RasterStage::RasterStage(const cl::Queue& queue, const FrameInput& input, const Geometry& g,
                         const WetStage& wet, const ShellOptions& options)
    : mapping_(mapping_of(options.mapping, queue.device())),
      tuning_(tuning_of(mapping_, options.tuning)),
      params_(tiled(raster_params(input, g), tuning_, queue.device())),
      options_(build_options(mapping_.lanes, tuning_)),
      one_lane_(build_options(1, tuning_)),
      layers_at_once_(layers_at_once(params_, options.layers_at_once, queue.device())),
      packed_(std::async(std::launch::async, [&] { return packed_fur(input.fur); })),
      geometry_(queue.device(), "rasterize/geometry/geometry.cl", options_),
      raster_(queue.device(), mapping_.file, options_),
      tips_(geometry_, "vertex_tips"),
      layers_(geometry_, "layer_vertices"),
      records_(geometry_, "vertex_records"),
      count_(geometry_, "bin_count"),
      sum_(geometry_, "bin_sum"),
      start_(geometry_, "bin_start"),
      fill_(geometry_, "bin_fill"),
      table_(upload(queue, layer_table(input.scene))),
      vertex_(upload(queue, g.vertex)),
      uv_(upload(queue, g.uv)),
      tangent_(upload(queue, g.tangent)),
      weight_(upload(queue, g.weight)),
      corner_(upload(queue, g.corner)),
      slice_(upload(queue, g.slice)),
      strand_(upload(queue, g.strand)),
      fur_(upload(queue, packed_.get())),
      coat_(upload(queue, packed_coat(input.coat))),
      mask_(&wet.mask()) {
  const cl::Device& device = queue.device();
  params_.group = std::min(params_.group, layers_at_once_);
  set_pass(0);
  const auto vertices = std::size_t(g.vertices), screens = vertices * std::size_t(layers_at_once_ + 1);
  const std::size_t tiles = std::size_t(params_.tiles_x) * std::size_t(params_.tiles_y);
  const std::size_t pixels = std::size_t(params_.width) * std::size_t(params_.height);
  dry_ = cl::Buffer<float>(device, vertices);
  tip_ = cl::Buffer<float>(device, 3 * vertices);
  record_ = cl::Buffer<float>(device, RECORD * vertices);
  screen_ = cl::Buffer<float>(device, 4 * screens);
  box_ = cl::Buffer<float>(device, 4 * vertices * std::size_t(params_.groups + 1));
  if (mapping_.name == "group") group_bins_ = std::make_unique<GroupBins>(device, params_, options_);
  length_ = cl::Buffer<std::int32_t>(device, tiles);
  list_start_ =
      cl::Buffer<std::int32_t>(device, 1 + (group_bins_ ? tiles * std::size_t(params_.groups) : tiles));
  list_ = cl::Buffer<std::int32_t>(device, 1);
  shown_ = cl::Buffer<std::int32_t>(device, 1);
  next_tile_ = cl::Buffer<std::int32_t>(device, 1);
  image_ = cl::Buffer<glm::vec4>(device, pixels);
  covered_ = cl::Buffer<std::uint32_t>(device, mapping_.name == "tile" ? tiles : pixels);

  const cl::Buffer<float> mask_uv = upload(queue, g.mask_uv);
  cl::Kernel dryness(geometry_, "vertex_dryness");
  dryness.with(params_, mask_uv, *mask_, dry_);
  const cl::Event event = dryness.enqueue(queue, vertices / std::size_t(mapping_.lanes));
  // Only sub-steps read them.
  curl_ = cl::Buffer<float>(device, params_.substeps > 1 ? RECORD * vertices : 1);
  cl::Event curls;
  if (params_.substeps > 1) {
    cl::Kernel kernel(geometry_, "vertex_curls");
    kernel.with(params_, vertex_, dry_, curl_);
    curls = kernel.enqueue(queue, vertices);
  }
  reach(queue);
  queue.finish();
}

// Once per mask, like the dryness: which layers each triangle reaches, into the corners' fourth column.
void RasterStage::reach(const cl::Queue& queue) {
  cl::Kernel kernel(geometry_, "triangle_reach");
  kernel.with(params_, table_, uv_, *mask_, corner_);
  const cl::Event event = kernel.enqueue(queue, std::size_t(params_.triangles));
  queue.finish();
}

double RasterStage::build_ms() const {
  return geometry_.build_ms() + raster_.build_ms() + (group_bins_ ? group_bins_->build_ms() : 0);
}

void RasterStage::bin(const cl::Queue& queue, PhaseEvents* events) {
  if (group_bins_) return group_bins_->make(queue, params_, corner_, box_, list_start_, list_, events);
  const auto keep = [&](cl::Event event) {
    if (events) events->emplace_back("bin", std::move(event));
  };
  const auto chunks = std::size_t(params_.chunks);
  const std::size_t tiles = std::size_t(params_.tiles_x) * std::size_t(params_.tiles_y);
  if (chunk_count_.size() == 0) chunk_count_ = cl::Buffer<std::int32_t>(queue.device(), tiles * chunks);
  count_.with(params_, corner_, box_, chunk_count_);
  keep(count_.enqueue(queue, chunks, 1));
  sum_.with(params_, chunk_count_, length_);
  keep(sum_.enqueue(queue, tiles));
  start_.with(params_, length_, list_start_, next_tile_);
  keep(start_.enqueue(queue, 1));
  // The lists are as long as they need to be: no triangle is ever dropped.
  std::array<std::int32_t, 1> total{};
  list_start_.read(queue, total, length_.size());
  if (total[0] == std::numeric_limits<std::int32_t>::max())
    throw DeviceError(
        "the bins would hold 2^31 triangles or more: draw a smaller picture or mesh, or stand back from it");
  if (std::size_t(total[0]) > list_.size()) {
    const std::size_t room = std::size_t(total[0]) * 5 / 4;
    list_ = cl::Buffer<std::int32_t>(queue.device(), room);
    if (mapping_.name == "tile")
      shown_ = cl::Buffer<std::int32_t>(queue.device(), 4 * (room + tiles * std::size_t(mapping_.lanes)));
  }
  fill_.with(params_, corner_, box_, chunk_count_, list_start_, list_);
  keep(fill_.enqueue(queue, chunks, 1));
}

cl::Event RasterStage::raster(const cl::Queue& queue, const cl::Program& program) {
  cl::Kernel kernel(program, mapping_.kernel);
  const std::size_t tiles = std::size_t(params_.tiles_x) * std::size_t(params_.tiles_y);
  if (mapping_.name != "tile") {
    kernel.with(params_, table_, corner_, screen_, vertex_, tip_, dry_, list_start_, list_, record_, tangent_,
                curl_, fur_, coat_, *mask_, image_, covered_);
    if (mapping_.name == "group") return kernel.enqueue(queue, tiles * group_items, group_items);
    return kernel.enqueue(queue, {std::size_t(params_.width), std::size_t(params_.height)});
  }
  kernel.with(params_, table_, corner_, screen_, box_, vertex_, tip_, dry_, list_start_, list_, shown_,
              record_, tangent_, curl_, fur_, coat_, *mask_, image_, covered_, next_tile_);
  // Work-items fetch tiles until there are none. Platforms hand them to threads by the dozen: more than
  // threads.
  return kernel.enqueue(queue, std::min(tiles, 32 * std::size_t(queue.device().info().compute_units)), 1);
}

void RasterStage::frame(const cl::Queue& queue, const cl::Buffer<float>* strand_state, int strand_stride,
                        PhaseEvents* events) {
  const auto keep = [&](const char* phase, cl::Event event) {
    if (events) events->emplace_back(phase, std::move(event));
  };
  const std::size_t blocks = std::size_t(params_.vertices / mapping_.lanes);
  if (strand_state) {
    tips_.with(params_, slice_, strand_, weight_, *strand_state, std::int32_t(strand_stride), tip_);
    keep("transform", tips_.enqueue(queue, blocks));
  }
  records_.with(params_, vertex_, tip_, uv_, record_);
  keep("transform", records_.enqueue(queue, std::size_t(params_.vertices)));
  for (int pass = passes() - 1; pass >= 0; --pass) {
    begin_pass(queue, pass, events);
    keep("raster", raster(queue, raster_));
  }
}

std::uint64_t RasterStage::count(const cl::Queue& queue) {
  const cl::Program counting(queue.device(), mapping_.file, options_ + " -D COUNT_FRAGMENTS");
  // Coverage is a matter of geometry: triangles that their clumps hide count too.
  const int every_layer = std::exchange(params_.every_layer, 1);
  for (int pass = passes() - 1; pass >= 0; --pass) {
    begin_pass(queue, pass, nullptr);
    const cl::Event event = raster(queue, counting);
  }
  queue.finish();
  params_.every_layer = every_layer;
  const std::vector<std::uint32_t> parts = covered_.read(queue);
  return std::accumulate(parts.begin(), parts.end(), std::uint64_t(0));
}

Picture RasterStage::read(const cl::Queue& queue) const {
  return Picture{params_.width, params_.height, image_.read(queue)};
}

}  // namespace pelage::shells

namespace pelage {

const std::vector<std::string>& mappings() {
  static const std::vector<std::string> names{"tile", "pixel", "group"};
  return names;
}

std::string default_mapping(const cl::DeviceInfo& device) {
  return device.gpu ? "group" : "tile";
}

}  // namespace pelage
