// Measures the cost of more layers: the frame times with all, half and a quarter of the layers, and their
// ratios.
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// Draws in every round a frame with all of the case's layers, one with half of them and one with a quarter.
/// `make` makes a subject for each, which is checked by itself. The row is that of all layers. It also holds
/// the other times as phases "half" and "quarter" and, as metrics "half_ratio" and "quarter_ratio", the
/// median over the rounds of the whole frame's time divided by theirs, with its 95% interval. Throws
/// InputError if the number of layers is not a multiple of 4.
std::unique_ptr<Subject> fewer_layers(const MakeSubject& make, const Case& which);

}  // namespace pelage
