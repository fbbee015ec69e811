// Checks the axes of an experiment before the list of its cases is made. An axis is a quantity that varies
// over the cases.
#pragma once
#include <string>
#include <vector>

#include "harness/experiment/experiment.hpp"

namespace pelage {

/// Returns whether `key` is the name of a scene key, such as "fur.length".
bool is_scene_key(const std::string& key);

/// Returns the same text for values of an axis that are equal as numbers: "0.1" for "0.1" and for "0.10".
std::string canonical(const std::string& value);

/// Returns whether the table [axis.value] of the experiment file contains the scene key `key`.
bool table_sets(const Experiment& experiment, const std::string& axis, const std::string& value,
                const std::string& key);

/// Checks `axes`: the axes of the experiment after `preset` and `overrides` have replaced or added axes.
/// Throws InputError
/// - if the key of an axis is unknown: it is no built-in axis (such as "layers"), no scene key, and the
///   experiment file has no table [KEY.VALUE] for it;
/// - if the values of an axis are names of tables, and a value does not occur in the file. It is probably
///   misspelled on the command line. A value that occurs in the file needs no table; it then sets no scene
///   keys;
/// - if a table sets a scene key that another axis of the file varies;
/// - if --set sets a scene key that an axis varies.
void check_axes(const Experiment& experiment, const Preset& preset, const Overrides& overrides,
                const std::vector<Axis>& axes);

}  // namespace pelage
