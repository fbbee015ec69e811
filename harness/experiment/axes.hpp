// Checks of the axes of an experiment, before its cases are enumerated.
#pragma once
#include <string>
#include <vector>

#include "harness/experiment/experiment.hpp"

namespace pelage {

/// Returns whether `key` is the name of a scene key, such as "fur.length".
bool is_scene_key(const std::string& key);

/// Returns a text that is equal for equal values of an axis. "0.1" and "0.10" are equal values.
std::string canonical(const std::string& value);

/// Returns whether the table [axis.value] of the experiment file contains the scene key `key`.
bool table_sets(const Experiment& experiment, const std::string& axis, const std::string& value,
                const std::string& key);

/// Checks `axes`, the axes of the experiment with those of `preset` and `overrides`. Throws InputError
/// - for an axis that is neither one of pelage's own, nor a scene key, nor a name for which the file has
///   tables;
/// - for a value of a named axis that has no table and is not in the file. Thus a misspelled value on the
///   command line is an error. A value without a table, beside other values with tables, sets no keys;
/// - if a table sets a scene key that another axis of the file varies;
/// - if --set sets a scene key that an axis varies.
void check_axes(const Experiment& experiment, const Preset& preset, const Overrides& overrides,
                const std::vector<Axis>& axes);

}  // namespace pelage
