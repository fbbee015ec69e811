// The fur volume: strands cut by N parallel planes (S 3.1), the recipe of the look.
#pragma once
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Grows `fur.strands` guard hairs and `fur.undercoat` short ones on a square that repeats, pulls them
/// together into locks, bends them, and cuts them at h = (1+n)/N. The same scene gives the same bytes
/// everywhere.
///
/// Coverage a of a texel is the greatest of its strands' (16 sub-samples each); it is stored as 1 -
/// (1-a)^(16/N), so that a ray crosses as much fur whatever N. Shade is 1 +- `fur.shade` and is spread around
/// the strands, so that a bilinear lookup meets no foreign shade.
FurTexture make_fur_texture(const FurScene& fur);

}  // namespace pelage
