// Hashes of inputs of a measurement. A row records such an input twice: its hash is a part of the row's
// identity, and another field of the row describes the input too. If the hash does not agree with the other
// field, somebody has changed the row (harness/record/contradiction.hpp).
#pragma once
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace pelage {

/// Names of two parts of an identity. "build" is the hash of pelage's compiler and flags. "renderer" is the
/// hash of the OpenGL renderer and its number of threads.
inline constexpr const char *build_part = "build", *renderer_part = "renderer";

/// Returns the hash of the values of the kernels' tuning parameters. It is the part "tuning" of an identity.
std::string tuning_hash(const std::map<std::string, int>& tuning);

/// Returns the hash of the entries that device_provenance() wrote into `provenance`. It is the part "device"
/// of an identity. Returns "" if the provenance does not name a device.
std::string device_hash(const nlohmann::ordered_json& provenance);

/// Returns a hash of `renderer` (a result of opengl_renderer()) and of the environment variable
/// LP_NUM_THREADS, which sets the number of threads of the software renderer llvmpipe.
std::string renderer_hash(const std::string& renderer);

/// Returns the random seed of a case. The seed selects the windows (squares of pixels) in which the picture
/// of the case is compared with the reference picture.
std::uint32_t check_seed(const std::string& case_name);

}  // namespace pelage
