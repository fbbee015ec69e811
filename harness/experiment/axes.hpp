// Checks the axes of an experiment before the list of its cases is made.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "harness/experiment/experiment.hpp"

namespace pelage {

bool is_scene_key(const std::string& key);

/// True for "reading" and for an axis whose name the author of the experiment file chose.
bool is_named(const std::string& axis);

/// Returns the same text for values that are equal as numbers: "0.1" for "0.1" and for "0.10".
std::string canonical(const std::string& value);

/// Returns all values of the axis in the tables [axes] of the experiment file and of its presets.
std::set<std::string> axis_values(const Experiment& experiment, const std::string& key);

bool table_sets(const Experiment& experiment, const std::string& axis, const std::string& value,
                const std::string& key);

/// Checks `axes`: the axes of the experiment after `preset` and `overrides` have replaced or added axes.
/// Throws InputError
/// - if the key of an axis is unknown: it is neither a built-in axis (such as "layers") nor a scene key, and
///   the experiment file has no table [KEY.VALUE] with this key;
/// - if the values of an axis are names of tables, and a value does not occur in the experiment file, because
///   such a value is probably misspelled on the command line;
/// - if a table sets a scene key that another axis of the file varies;
/// - if --set sets a scene key that an axis varies.
/// A value that the experiment file lists for an axis may have no table. Such a value sets no scene keys.
void check_axes(const Experiment& experiment, const Preset& preset, const Overrides& overrides,
                const std::vector<Axis>& axes);

}  // namespace pelage
