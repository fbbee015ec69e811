// What more layers cost, as a ratio of frames drawn in turns.
#pragma once
#include "harness/measure/subject.hpp"

namespace pelage {

/// Cases whose pipeline is "shells+fewer" draw in every round a frame with all their layers, one with half of
/// them and one with a quarter, each a subject of `shells` that is checked for itself. The row is that of all
/// layers, and holds besides: the others' times as phases "half" and "quarter", and as metrics "half_ratio"
/// and "quarter_ratio" the median over rounds of the whole frame's time by theirs with its 95% interval.
/// Other cases go to `shells`. Throws InputError where the layers are no multiple of 4.
MakeSubject with_fewer_layers(const MakeSubject& shells);

}  // namespace pelage
