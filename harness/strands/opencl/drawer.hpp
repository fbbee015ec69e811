// Draws strands on an OpenCL device. docs/strands.md, section Drawing, defines the picture.
#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/cl/radix_sort.hpp"
#include "harness/picture/picture.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/drawing/keyed.hpp"
#include "harness/strands/opencl/program_texts.hpp"
#include "kernels/strands/draw/params.h"

namespace pelage::strands {

/// The buffers of the strands, of which a picture and its opacity map are drawn. `shapes` has the columns of
/// shape_columns(), or one float if the strands have no shapes.
struct StrandBuffers {
  const cl::Buffer<float>&constants, &shapes, &keys;
  const cl::Buffer<std::int32_t>&layers, &film;
};

/// The kernels that draw strands into a picture or into an opacity map: they compute the curves and sort
/// keys, list the strands that each tile may show (kernels/strands/draw/bins.cl), and draw the tiles.
class StrandPass {
 public:
  /// params.tiles_x, tiles_y, capacity, runs and chunks must be set. `padded` is the number of strands,
  /// rounded up to a multiple of 16. `shapes`: the strands have shapes.
  StrandPass(const cl::Queue& queue, const DrawParams& params, const PictureTexts& texts,
             const DrawerLayout& layout, std::size_t padded, bool shapes);

  /// Enqueues the kernel that writes the curves and the sort keys.
  void make_keys(const cl::Queue& queue, const DrawParams& params, const StrandBuffers& strands,
                 const char* phase, cl::PhaseEvents* events);

  /// Enqueues the kernels that list the first total[0] pairs and draw the tiles, in the phases `list_phase`
  /// and `draw_phase`. film, map, skin: see strand_tiles (tile.cl). The host waits once, because it needs the
  /// total length of the lists to allocate them. Throws DeviceError if it is 2^31 or more.
  void draw(const cl::Queue& queue, const DrawParams& params, const cl::Buffer<std::int32_t>& total,
            const cl::Buffer<std::int32_t>& film, const cl::Buffer<glm::vec4>& map,
            const cl::Buffer<glm::vec4>& skin, const char* list_phase, const char* draw_phase,
            cl::PhaseEvents* events);

  cl::Buffer<cl::Pair>& pairs() { return pairs_; }  ///< the sort keys, in params.runs runs
  const cl::Buffer<cl::Pair>& pairs() const { return pairs_; }
  const cl::Buffer<std::int32_t>& live() const { return live_; }  ///< number of pairs of each run
  /// All curves, if params.keep_curves is set. The buffer then has CURVE_COLUMNS columns.
  cl::Buffer<float>& curves() { return curves_; }
  const cl::Buffer<glm::vec4>& image() const { return image_; }
  std::vector<const cl::Program*> programs() const { return {&key_program_, &list_program_, &draw_program_}; }

 private:
  DrawerLayout layout_;
  cl::Program key_program_, list_program_, draw_program_;
  cl::Kernel make_keys_, count_, sum_, start_, fill_, draw_;
  cl::Buffer<float> rows_, curves_;
  cl::Buffer<std::uint64_t> blocks_;
  cl::Buffer<cl::Pair> pairs_;
  cl::Buffer<std::int32_t> live_, chunk_count_, length_, list_start_, list_, taken_;
  cl::Buffer<std::uint16_t> spot_, blank_;
  cl::Buffer<glm::vec4> image_;
};

class OpacityMap {
 public:
  /// `kinds`, `picture`: of the picture for which the map is made. params.chunks and runs must be set, and
  /// `padded` is the number of strands, rounded up to a multiple of 16.
  OpacityMap(const cl::Queue& queue, const DrawParams& params, const LightView& view,
             const PictureKinds& kinds, const DrawerLayout& picture, std::size_t padded);

  /// Enqueues the kernels that draw the map, all in the phase `shadow`. `params` describes the picture.
  void enqueue(const cl::Queue& queue, const DrawParams& params, const LightView& view,
               const StrandBuffers& buffers, cl::PhaseEvents* events);

  /// The texels, row by row: least depth of the fragments in R (NO_DEPTH: none), 1 / D in 1/R
  /// (docs/strands.md, section Shadow), transmittance 1 - A, and 0.
  const cl::Buffer<glm::vec4>& texels() const { return pass_.image(); }
  std::vector<const cl::Program*> programs() const { return pass_.programs(); }

 private:
  DrawerLayout layout_;
  StrandPass pass_;
  cl::Buffer<std::int32_t> total_;
  cl::Buffer<glm::vec4> nothing_;  ///< the map and the skin, which the kernels do not read
  int strands_ = -1;               ///< the number in total_
};

/// Sets the rows of `params` with which a kernel finds a point of the picture in the opacity map.
void set_map_rows(DrawParams& params, const Camera& camera, const Look& look);

class SkinDrawer {
 public:
  /// `params.width` and `params.height` must be set. `lanes`: number of vertices, triangles or pixels that a
  /// work-item computes at a time, 1 or 16. `text`: skin_text() with the same `lanes`. Throws InputError if
  /// the surface has no triangles.
  SkinDrawer(const cl::Queue& queue, const DrawParams& params, const SkinSurface& skin, int lanes,
             const cl::ProgramText& text);

  /// Enqueues the kernels that draw the skin. Their launches belong to the phase `skin`. `map` has the texels
  /// of the opacity map.
  void enqueue(const cl::Queue& queue, const DrawParams& params, const cl::Buffer<glm::vec4>& map,
               cl::PhaseEvents* events);

  /// Replaces the positions and normals of the vertices. Throws InputError if their number is wrong.
  void deform(const cl::Queue& queue, const SkinSurface& skin);

  /// Returns the pixels, row by row. A pixel has red, green, blue and the view depth in R. The depth is
  /// NO_DEPTH if the pixel has no skin.
  const cl::Buffer<glm::vec4>& pixels() const { return pixels_; }
  const cl::Program& program() const { return program_; }

 private:
  int vertices_, triangles_, pixel_count_, lanes_;
  cl::Program program_;
  cl::Kernel make_vertices_, clear_, find_depth_, find_owner_, colour_pixels_;
  cl::Buffer<glm::vec3> position_, normal_, colour_;
  cl::Buffer<float> vertex_;
  cl::Buffer<glm::uvec3> index_;
  cl::Buffer<std::int32_t> owner_;
  cl::Buffer<std::uint32_t> depth_;
  cl::Buffer<glm::vec4> pixels_;
};

class Drawer {
 public:
  /// `keys` is the number of key strands. Throws InputError if a value is not valid.
  Drawer(const cl::Queue& queue, const DrawingScene& scene, const std::vector<KeyedStrand>& strands,
         std::size_t keys, const DrawerOptions& options = {});

  /// The key strands on the device: KEY_RECORD floats each, with room for their number rounded up to a
  /// multiple of 16. The caller writes them before enqueue(), for instance by Chains::write_keys().
  cl::Buffer<float>& keys() { return keys_; }

  /// True if set_view() accepts the scene. It does not if the size of the picture or the film strip differs
  /// from the present scene's, or if the look has other kinds of light, for which the programs would have to
  /// be built again. Throws InputError if a value of the look is not valid.
  bool can_show(const DrawingScene& scene) const;

  /// Changes the camera, the look or the fraction of the following pictures, and builds nothing. Throws
  /// InputError if can_show() is false.
  void set_view(const DrawingScene& scene);

  /// Enqueues the kernels of one picture, in the phases keys, sort, bin and raster, and before them those of
  /// the opacity map, if the look has one, in the phase shadow, and those of the skin, if there is one, in
  /// the phase skin. Waits for the total length of the tiles' lists. Throws DeviceError if it is 2^31 or
  /// more.
  void enqueue(const cl::Queue& queue, cl::PhaseEvents* events);

  Picture read(const cl::Queue& queue) const;
  /// Returns the list of the last picture, from front to back.
  std::vector<Entry> order(const cl::Queue& queue) const;
  /// Returns all strands with the control points that the kernels compute from the present key strands. The
  /// picture may show only a part of these strands. Do not call order() between this call and the next call
  /// of enqueue(), because this call overwrites the list.
  std::vector<DrawnStrand> curves(const cl::Queue& queue);
  /// Replaces the positions and normals of the skin for all later pictures. The picture must have a skin, and
  /// the skin keeps its vertices and triangles.
  void deform_skin(const cl::Queue& queue, const SkinSurface& skin);
  /// Returns the texels of the last opacity map, row by row (OpacityMap::texels()). It is empty if the look
  /// has no shadow.
  std::vector<glm::vec4> opacity_map(const cl::Queue& queue) const;
  std::vector<const cl::Program*> programs() const;

 private:
  void enqueue_keys(const cl::Queue& queue, cl::PhaseEvents* events);
  void set_pruning(const Look& look);
  /// Writes layers_ to layer_table_ if set_view() has changed them.
  void write_layers(const cl::Queue& queue);
  StrandBuffers buffers() const { return {constants_, shapes_, keys_, layer_table_, film_}; }

  std::vector<KeyedStrand> strands_;
  DrawingScene scene_;
  std::vector<LayerLook> layers_;  ///< of all 256 possible fur layers
  PictureKinds kinds_;
  DrawerLayout layout_;
  cl::PairSort sort_;
  DrawParams params_;
  std::optional<StrandPass> pass_;
  std::optional<OpacityMap> map_;
  std::optional<SkinDrawer> skin_;
  cl::Buffer<float> constants_, shapes_, keys_;
  cl::Buffer<std::int32_t> film_, layer_table_;
  cl::Buffer<glm::vec4> nothing_;  ///< the kernels' argument without an opacity map or without a skin
  bool layers_written_ = false;
  int key_bits_;  ///< number of bits that the sort keys use
};

}  // namespace pelage::strands
