// Measures the cost of more layers: the frame times with all, half and a quarter of the layers, and their
// ratios.
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// Returns a subject that draws three frames in every round, one after another: with all layers of the case,
/// with half of them and with a quarter. Three separate subjects draw these frames, and each picture is
/// checked. Throws InputError if the number of layers is not a multiple of 4.
std::unique_ptr<Subject> make_fewer_layers(SubjectContext& context, const Case& which);

/// Does the same with subjects that `make` returns. The row is that of all layers. It also contains the times
/// with half and a quarter of the layers as phases "half" and "quarter". The metrics "half_ratio" and
/// "quarter_ratio" are medians over the rounds, with their 95% intervals, of the time with all layers divided
/// by those times.
std::unique_ptr<Subject> fewer_layers(const MakeSubject& make, const Case& which);

}  // namespace pelage
