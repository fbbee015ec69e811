// The identity of a row: hashes of everything that determines what the row measured. Rows with equal
// identities repeat one measurement and may be combined. Rows with different identities are different
// measurements, even if their cases have the same name.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "harness/cl/program.hpp"

namespace pelage {

/// Part of the identity -> 16 hex digits, a hash of the part's content. The parts are scene, mesh, variant,
/// tuning, sampling, device and, per OpenCL program that the case ran, "kernel FILE" with the hash of the
/// file and of all files that it includes. Frames of the OpenGL baseline also have the part "shaders". The
/// hash of the scene includes the contents of the texture files that the scene names. Rows of schema 1 have
/// no parts.
using Identity = std::map<std::string, std::string>;

/// Prefix of the parts that are OpenCL programs, and the part with the shaders of the OpenGL baseline.
inline constexpr const char *kernel_part = "kernel ", *shader_part = "shaders";

/// Adds one part per program: the hash of its sources as they were when the program was built.
void add_programs(Identity& identity, const std::vector<const cl::Program*>& programs);

/// Returns the names of the parts that differ, sorted. A part that only one identity has differs.
std::vector<std::string> differing_parts(const Identity& a, const Identity& b);

/// Returns one text per differing part: "scene was 0123..., is 4567...". An absent part is "absent".
std::vector<std::string> differences(const Identity& was, const Identity& is);

/// Returns 16 hex digits, a hash of all parts; "" if there are no parts.
std::string hash_of(const Identity& identity);

}  // namespace pelage
