// Reduces the size of pictures for the HTML page of a report.
#pragma once
#include "harness/picture/picture.hpp"

namespace pelage {

/// Returns a smaller copy of the picture with `most_width` columns and the same proportions. Each reduced
/// pixel is the mean of the original pixels that it covers, computed from gamma-encoded values. Alpha is
/// averaged, too. If the picture has at most `most_width` columns, returns it unchanged.
Picture reduced(const Picture& picture, int most_width);

}  // namespace pelage
