// Provenance of a row: program, machine, device, time.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/cl/device.hpp"

namespace pelage {

std::string utc_stamp();  ///< "20261121T001502Z", usable in a file name
std::string utc_now();    ///< "2026-11-21T00:15:02Z"
double load_average();    ///< average over the last minute
std::string host_name();  ///< up to the first dot
std::string cpu_model();  ///< /proc/cpuinfo's model name; "" if it cannot be read
std::string governor();   ///< frequency governor of the first CPU; "" if it cannot be read

/// Returns a name that is usable in a file name: keeps letters, digits, '.', '_' and '-', replaces others by
/// '_'.
std::string file_name_of(const std::string& text);

/// Returns the host's part, without the device. `anonymous` omits the host's name and reduces paths in argv
/// to file names.
nlohmann::ordered_json host_provenance(const std::vector<std::string>& argv, bool anonymous);

/// Returns platform, driver, device and its timer.
nlohmann::ordered_json device_provenance(const cl::DeviceInfo& info);

}  // namespace pelage
