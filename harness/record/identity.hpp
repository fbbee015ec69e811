// The identity of a row: hashes of everything that determines what the row measured. Rows with equal
// identities repeat the same measurement and may be combined. Rows with different identities come from
// different measurements, even if their cases have the same name.
#pragma once
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace pelage {

/// Maps the name of each part of the identity to a hash of its content (16 hex digits): "scene", "mesh",
/// "variant", "tuning", "sampling", "device", "build", and "kernel FILE" for each OpenCL program that the
/// case ran (with all files that FILE includes); "shaders" and "renderer" for the OpenGL baseline. The hash
/// of the scene covers the texture files and the mesh file that it names. Rows in the old format (schema 1)
/// have no parts.
using Identity = std::map<std::string, std::string>;

/// The beginning of the names of the parts for OpenCL programs; the names of those for the OpenGL baseline's
/// shaders and its renderer (with its number of threads), and for pelage's compiler and flags.
inline constexpr const char *kernel_part = "kernel ", *shader_part = "shaders", *renderer_part = "renderer",
                            *build_part = "build";

/// Returns the sorted names of the parts whose hashes differ or that only one identity has.
std::vector<std::string> differing_parts(const Identity& a, const Identity& b);

/// Returns one text per differing part: "scene was 0123..., is 4567...", or "absent" for a missing part.
std::vector<std::string> differences(const Identity& was, const Identity& is);

/// Returns a hash of all parts; "" if there are none.
std::string hash_of(const Identity& identity);

/// The part "tuning" of an identity.
std::string tuning_hash(const std::map<std::string, int>& tuning);

/// The part "device": the hash of what device_provenance() wrote; "" if the provenance does not name a
/// device.
std::string device_hash(const nlohmann::ordered_json& provenance);

/// Returns the value as one line of JSON. Bytes that are not UTF-8, which driver strings and logs may
/// contain, are replaced; otherwise dump() would throw and the row would be lost.
std::string json_line(const nlohmann::ordered_json& value);

/// Returns a hash of `renderer` (a result of opengl_renderer()) and of LP_NUM_THREADS, the number of threads
/// of the software renderer llvmpipe.
std::string renderer_hash(const std::string& renderer);

/// Returns the random seed that selects the windows in which the picture of a case is compared.
std::uint32_t check_seed(const std::string& case_name);

}  // namespace pelage
