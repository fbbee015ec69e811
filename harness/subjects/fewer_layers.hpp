// What more layers cost, as a ratio of frames drawn in turns.
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// Draws in every round a frame with all of the case's layers, one with half of them and one with a quarter,
/// each a subject of its own that is checked by itself. Throws InputError where the layers are no multiple
/// of 4.
std::unique_ptr<Subject> make_fewer_layers(SubjectContext& context, const Case& which);

/// The same with subjects by `make`. The row is that of all layers, and holds besides: the others' times as
/// phases "half" and "quarter", and as metrics "half_ratio" and "quarter_ratio" the median over rounds of the
/// whole frame's time by theirs with its 95% interval.
std::unique_ptr<Subject> fewer_layers(const MakeSubject& make, const Case& which);

}  // namespace pelage
