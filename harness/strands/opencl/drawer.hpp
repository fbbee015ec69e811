// Draws strands on an OpenCL device. docs/strands.md, section Drawing, defines the picture.
#pragma once
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/cl/pair_sort.hpp"
#include "harness/cl/program.hpp"
#include "harness/picture/picture.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/drawing/keyed.hpp"
#include "harness/strands/opencl/opacity_map.hpp"
#include "harness/strands/opencl/program_texts.hpp"
#include "harness/strands/opencl/skin_drawer.hpp"
#include "harness/strands/opencl/tile_lists.hpp"

namespace pelage::strands {

/// What a picture shows, and from where.
struct DrawingScene {
  Camera camera;
  Look look;
  DepthRange range;                         ///< see depth_range()
  float first_segment = 0.5f;               ///< length of the first segment, in lengths of the strand
  std::shared_ptr<const SkinSurface> skin;  ///< null: the picture has no skin
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
  /// be built again.
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
  /// Number of strands in the tiles' lists of the last picture. A strand counts once per tile.
  std::size_t listed() const { return lists_.listed(); }
  /// Returns the texels of the last opacity map, row by row (OpacityMap::texels()). It is empty if the look
  /// has no shadow.
  std::vector<glm::vec4> opacity_map(const cl::Queue& queue) const;
  std::vector<const cl::Program*> programs() const;

 private:
  void enqueue_keys(const cl::Queue& queue, cl::PhaseEvents* events);
  void set_pruning(const Look& look);
  /// Writes layers_ to layer_table_ if set_view() has changed them.
  void write_layers(const cl::Queue& queue);
  std::vector<KeyedStrand> strands_;
  DrawingScene scene_;
  std::vector<LayerLook> layers_;  ///< of all 256 possible fur layers
  PictureKinds kinds_;
  DrawerLayout layout_;
  PictureTexts texts_;
  cl::PairSort sort_;
  DrawParams params_;
  cl::Program key_program_, draw_program_;
  cl::Kernel make_keys_, draw_;
  TileLists lists_;
  std::optional<OpacityMap> map_;
  std::optional<SkinDrawer> skin_;
  cl::Buffer<float> constants_, keys_, rows_, curves_;
  cl::Buffer<std::uint64_t> blocks_;
  cl::Buffer<cl::Pair> pairs_;
  cl::Buffer<std::int32_t> film_, layer_table_, live_;
  cl::Buffer<glm::vec4> no_map_;   ///< the kernels' argument if the look has no shadow
  cl::Buffer<glm::vec4> no_skin_;  ///< the kernels' argument if the picture has no skin
  cl::Buffer<glm::vec4> image_;
  bool layers_written_ = false;
  int key_bits_;  ///< number of bits that the sort keys use
};

}  // namespace pelage::strands
