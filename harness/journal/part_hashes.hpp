// Hashes of inputs of a measurement that are recorded twice: as a part of the row's identity, and in another
// field of the row. A row in which the two differ was changed (harness/journal/contradiction.hpp).
#pragma once
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace pelage {

/// Names of parts of an identity: compiler and flags of pelage; driver of the OpenGL baseline.
inline constexpr const char *build_part = "build", *renderer_part = "renderer";

/// Returns the hash of the values of the kernels' tuning axes: the part tuning.
std::string tuning_hash(const std::map<std::string, int>& tuning);

/// Returns the hash of the entries of device_provenance() in `provenance`: the part device. Returns "" if the
/// provenance does not name a device.
std::string device_hash(const nlohmann::ordered_json& provenance);

/// Returns the hash of pelage's compiler and its flags. They change the time that the host needs per frame,
/// and the times of the baselines in C++.
std::string build_hash();

/// Returns the hash of the OpenGL baseline's renderer, as opengl_renderer() returns it, and of the
/// environment variable LP_NUM_THREADS, which sets the number of llvmpipe's threads.
std::string renderer_hash(const std::string& renderer);

/// Returns the seed that chooses the windows in which the picture of a case is compared with the reference.
std::uint32_t check_seed(const std::string& case_name);

}  // namespace pelage
