// Reads one file of a .tar.gz archive.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace pelage {

/// Returns the bytes of the file `member`; empty if the archive does not contain it. Throws InputError if the
/// archive is missing or damaged, or if `member` is larger than 1 GiB.
std::optional<std::string> read_member(const std::filesystem::path& archive, const std::string& member);

}  // namespace pelage
