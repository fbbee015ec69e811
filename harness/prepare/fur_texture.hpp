// Generates the fur volume texture: hairs intersected with N parallel planes (S 3.1).
#pragma once
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Generates `fur.strands` guard hairs and `fur.undercoat` short hairs on a repeating square. Each hair is
/// displaced towards the centre of the nearest lock of hair, and bent. The hairs are then intersected with
/// the planes at the heights h = (1+n)/N. The same parameters give the same bytes on every machine.
///
/// The coverage a of a texel is the greatest coverage by a single strand, computed from 16 sub-samples. It is
/// stored as 1 - (1-a)^(16/N), so that the opacity along a ray does not depend on N. The shade of a hair is a
/// random value between 1 - `fur.shade` and 1 + `fur.shade`. Empty texels have the shade of neighbouring
/// strands, so that bilinear interpolation at the edge of a strand keeps the strand's shade.
FurTexture make_fur_texture(const FurScene& fur);

}  // namespace pelage
