// Where a row comes from: program, machine, device, time.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/cl/device.hpp"

namespace pelage {

std::string utc_stamp();  ///< "20261121T001502Z", fit for a file name
std::string utc_now();    ///< "2026-11-21T00:15:02Z"
double load_average();    ///< over the last minute
std::string host_name();  ///< up to the first dot
std::string cpu_model();  ///< /proc/cpuinfo's model name; "" where it cannot be read
std::string governor();   ///< of the first CPU's frequency; "" where it cannot be read

/// A name fit for a file: letters, digits, '.', '_' and '-', the rest '_'.
std::string file_name_of(const std::string& text);

/// The host's part, without the device. `anonymous` leaves out the host's name and reduces paths in argv to
/// names.
nlohmann::ordered_json host_provenance(const std::vector<std::string>& argv, bool anonymous);

/// Platform, driver, device and its timer.
nlohmann::ordered_json device_provenance(const cl::DeviceInfo& info);

}  // namespace pelage
