// Measures the cost of more layers: the frame times with all, half and a quarter of the layers, and their
// ratios.
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns a subject (an object that the harness times) that draws three frames in every round: with all of
/// the case's layers, with half of them and with a quarter of them. `make` makes one subject for each number
/// of layers. The subject's check() checks the pictures of all three. In the row of results, the phase (a
/// named list of times) "frame" contains the times with all layers. The phases "half" and "quarter" contain
/// the times with half and with a quarter of the layers. The metric "half_ratio" is the frame time with all
/// layers divided by the frame time with half of the layers. The metric "quarter_ratio" is the frame time
/// with all layers divided by the frame time with a quarter of the layers. Each metric is a median over the
/// rounds, with its 95% interval. Throws InputError if the number of layers is not a multiple of 4. `layers`
/// is the number of layers of the case's scene.
std::unique_ptr<Subject> fewer_layers(const MakeSubject& make, const Case& which, int layers);

}  // namespace pelage
