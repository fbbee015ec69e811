// Reduced copies of pictures, for pages.
#pragma once
#include "harness/picture/picture.hpp"

namespace pelage {

/// Returns the picture with at most `most_width` columns and the same proportions. Each pixel is the mean of
/// the pixels that it covers, in the picture's gamma space; alpha is averaged too. A picture that is not
/// wider is returned unchanged.
Picture reduced(const Picture& picture, int most_width);

}  // namespace pelage
