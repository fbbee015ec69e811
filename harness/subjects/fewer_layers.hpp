// Measures the cost of more layers: the frame times with all, half and a quarter of the layers, and their
// ratios.
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns a subject (an object that the harness times) that draws three frames in every round: with all of
/// the case's layers, with half of them and with a quarter of them (phases "half" and "quarter", metrics
/// "frame_over_half" and "frame_over_quarter" of harness/measure/turns.hpp). `make` makes one subject for
/// each number of layers. check() checks the pictures of all three. Throws InputError if the number of layers
/// is not a multiple of 4. `layers` is the number of layers of the case's scene.
std::unique_ptr<Subject> fewer_layers(const MakeSubject& make, const Case& which, int layers);

}  // namespace pelage
