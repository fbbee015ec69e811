// Rows that differ only in settings of their device, such as its number of threads.
#pragma once
#include <vector>

#include "harness/record/results_folder.hpp"

namespace pelage {

/// If rows of one experiment, device and host have equal names, and their identities differ in the part
/// "device" alone, adds those settings to Row::axes in which they differ: "compute_units", "usable_cores",
/// "cpu_quota", "lanes", a version such as "driver", or an environment variable such as
/// POCL_WORK_GROUP_METHOD ("unset" for rows without it). All rows of that experiment, device and host get
/// these axes. A setting that tells no more rows apart is not added. If some of these rows also differ in
/// another part, none gets an axis.
void add_settings_as_axes(std::vector<FoundRow>& rows);

/// Whether add_settings_as_axes() may have added the axis: a setting of a device does not change pictures.
bool is_device_setting(const std::string& axis);

}  // namespace pelage
