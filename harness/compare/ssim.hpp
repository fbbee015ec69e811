// The structural similarity of two pictures.
#pragma once
#include "harness/picture/picture.hpp"

namespace pelage {

/// Returns the mean structural similarity (SSIM) of the lumas of two pictures (Wang, Bovik, Sheikh and
/// Simoncelli, Image Quality Assessment, 2004, Eq. 13, with the constants K1 = 0.01, K2 = 0.03 and the peak
/// 1): 1 if they are equal, less otherwise. The windows are squares of 8 x 8 pixels with equal weights, four
/// pixels apart; windows without a fur pixel are left out. The luma is that of Rec. 601, clamped to 0..1.
/// Returns 1 if there is no fur pixel. Throws InputError if the sizes differ.
double ssim(const Picture& a, const Picture& b);

}  // namespace pelage
