// Reads files of claims (TOML), such as experiments/claims.toml.
#pragma once
#include <filesystem>

#include "harness/claims/claim.hpp"

namespace pelage::claims {

/// Reads a file of claims and the files that its key `include` names. The InputError for a file with an error
/// names the file, the line, the key and the correct form.
ClaimFile read_claims(const std::filesystem::path& file);

/// Returns the path of the shipped file experiments/claims.toml. Throws InputError if it is not installed.
std::filesystem::path shipped_claims();

}  // namespace pelage::claims
