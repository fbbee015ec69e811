// Generates the fur volume texture: hairs intersected with N parallel planes (section 3.1 of Silva et al.
// 2010, Curling and Clumping Fur; see docs/shells.md).
#pragma once
#include "harness/prepare/frame_input.hpp"

namespace pelage {

/// Generates `fur.strands` guard hairs and `fur.undercoat` short hairs on a repeating square. Each hair is
/// displaced towards the centre of the nearest lock of hair, and bent. The hairs are then intersected with N
/// planes, where N is fur.layers. The height of plane n, for n from 0 to N-1, is (1+n)/N times the length of
/// the fur. The same parameters give the same bytes on every machine.
///
/// Let a be the greatest coverage of a texel by a single strand, computed from 16 sub-samples. The texel
/// stores the coverage 1 - (1-a)^p with p = 16/N, so that the opacity along a ray hardly depends on N. If
/// `fur.layer_correction` is "fragment", the texel stores a, and coverage_power() is p. The shade of a
/// hair is a random value between 1 - `fur.shade` and 1 + `fur.shade`. Empty texels have the shade of
/// neighbouring strands, so that bilinear interpolation at the edge of a strand keeps the strand's shade.
FurTexture make_fur_texture(const FurScene& fur);

/// Returns the exponent p by which a coverage c from the texture is corrected after the lookup: it becomes
/// 1 - (1-c)^p. p is 1 if the texels are corrected.
double coverage_power(const FurScene& fur);

}  // namespace pelage
