// Reads files of claims (TOML), such as experiments/claims.toml.
#pragma once
#include <filesystem>

#include "harness/claims/claim.hpp"

namespace pelage::claims {

/// Reads a file of claims. Throws InputError, whose message names the file, the line, the key and the
/// permitted values.
ClaimFile read_claims(const std::filesystem::path& file);

/// Returns the path of the shipped claims.toml. It is searched in the folder experiments/ of $PELAGE_DATA, of
/// the source tree and of the installation, in this order. Throws InputError if there is none.
std::filesystem::path shipped_claims();

}  // namespace pelage::claims
