// The scene keys of fur of single strands.
#pragma once
#include <string_view>
#include <vector>

#include "harness/scene/scene_keys.hpp"

namespace pelage {

/// Returns the keys [strands] and [strands.chain]. Key::slot points into `strands`.
std::vector<Key> strand_keys(StrandsScene& strands);

/// Returns the keys of one entry of [[strands.layer]] or [[strands.fill]], with short names.
std::vector<Key> strand_layer_keys(StrandLayerScene& layer);
std::vector<Key> strand_fill_keys(StrandFillScene& fill);

}  // namespace pelage
