#include "harness/strands/drawing/film_table.hpp"

#include <fmt/format.h>

#include <span>

#include "harness/error.hpp"

namespace pelage::strands {

FilmTable film_table(const Look& look) {
  const std::vector<FilmFrame> one(1);
  const std::span<const FilmFrame> film = look.film.empty() ? one : look.film;
  const bool own = has_layer_looks(look);
  FilmTable table;
  const auto add = [&](std::span<const FilmFrame> frames, const LayerLook& layer) {
    for (const FilmFrame& frame : frames) table.frames.push_back({frame, layer});
  };
  if (!own) add(film, {});
  table.layers.reserve(most_layers);
  for (int i = 0; i < most_layers; ++i) {
    LayerLook layer = layer_look(look, i);
    if (own && i < int(look.layers.size())) {
      const auto frames = film.subspan(std::size_t(layer.first_frame), std::size_t(layer.frames));
      layer.first_frame = int(table.frames.size());
      add(frames, layer);
    }
    table.layers.push_back(layer);
  }
  if (table.frames.size() > std::size_t(most_frames))
    throw InputError(
        fmt::format("film strips: {} frames; fur layers with looks of their own may have {} frames together",
                    table.frames.size(), most_frames));
  return table;
}

void need_looks(const Look& look, const std::vector<KeyedStrand>& strands) {
  if (look.back_facing == BackFacing::last)
    for (const KeyedStrand& s : strands)
      if (layer_look(look, s.layer).rank > 254)
        throw InputError("fur layers: with strands that face away last, at most 255 ranks are possible");
  if (!has_layer_looks(look)) return;
  for (const KeyedStrand& s : strands)
    if (s.layer >= look.layers.size())
      throw InputError(fmt::format("fur layer {}: it has no look; give one for each layer", s.layer));
}

}  // namespace pelage::strands
