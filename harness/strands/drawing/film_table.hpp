// The film strips and the looks of the fur layers in the order in which OpenCL and OpenGL read them.
#pragma once
#include <array>
#include <vector>

#include "harness/strands/drawing/drawing.hpp"
#include "harness/strands/drawing/keyed.hpp"

namespace pelage::strands {

/// A frame of the film strip with the look of the fur layer that uses it.
struct LayerFrame {
  FilmFrame film;
  LayerLook look;
  bool operator==(const LayerFrame&) const = default;

  /// Factors of opacity, taper, highlight, exponent of the highlight, and shadow of the skin.
  std::array<float, 5> factors() const {
    return {look.opacity, look.taper, look.gloss, look.exponent, look.skin_shadow};
  }
};

struct FilmTable {
  std::vector<LayerFrame> frames;  ///< without a film strip, one frame of factors 1, or one for each layer
  /// The layers 0 to most_layers - 1. first_frame is an index of `frames`.
  std::vector<LayerLook> layers;
};

/// Returns the table of a look. If has_layer_looks(look), each layer has frames of its own; otherwise the
/// frames are those of look.film, with factors 1. Throws InputError if these are more than most_frames.
FilmTable film_table(const Look& look);

/// Throws InputError if layers have looks of their own, but a strand's layer has no entry in look.layers; or
/// if a layer has a rank above 254 and strands that face away come last.
void need_looks(const Look& look, const std::vector<KeyedStrand>& strands);

}  // namespace pelage::strands
