// The identity of a row (the recorded result of a case): hashes of everything that determines what the row
// measured. Rows with equal identities repeat the same measurement and may be combined. Rows with different
// identities come from different measurements, even if their cases have the same name.
#pragma once
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace pelage {

/// Maps the name of each part of the identity to a hash of the part's content (16 hex digits). The parts are
/// "scene", "mesh", "variant", "tuning", "sampling", "device" and "build". There is also one part "kernel
/// FILE" for each OpenCL program that the case ran; its hash covers FILE and all files that FILE includes.
/// Rows of the OpenGL baseline also have the parts "shaders" and "renderer". The hash of the scene covers the
/// contents of the texture files and of the mesh file that the scene names. Rows in the old format (schema 1)
/// have no parts.
using Identity = std::map<std::string, std::string>;

/// `kernel_part` is the beginning of the names of the parts for OpenCL programs. `shader_part` is the name of
/// the part for the shaders of the OpenGL baseline.
inline constexpr const char *kernel_part = "kernel ", *shader_part = "shaders";

/// Returns the names of the parts whose hashes differ, sorted. A part that only one identity has counts as
/// different.
std::vector<std::string> differing_parts(const Identity& a, const Identity& b);

/// Returns one text per differing part: "scene was 0123..., is 4567...". For a missing part, the text
/// contains "absent" instead of a hash.
std::vector<std::string> differences(const Identity& was, const Identity& is);

/// Returns 16 hex digits, a hash of all parts; "" if there are no parts.
std::string hash_of(const Identity& identity);

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
