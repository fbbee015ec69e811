// Reads files of claims (TOML), such as experiments/claims.toml.
#pragma once
#include <filesystem>

#include "harness/claims/claim.hpp"

namespace pelage::claims {

/// Reads a file of claims. If the file has an error, throws InputError, whose message names the file, the
/// line, the key and the correct form.
ClaimFile read_claims(const std::filesystem::path& file);

/// Returns the path of the shipped claims.toml. The function searches the folder experiments/ in
/// $PELAGE_DATA, then in the installation or, for a program in a build folder, in the source tree. Throws
/// InputError if there is no such file.
std::filesystem::path shipped_claims();

}  // namespace pelage::claims
