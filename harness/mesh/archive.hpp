// One file out of a .tar.gz.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace pelage {

/// The bytes of `member`; empty when the archive holds no such file. Throws InputError when the archive is
/// missing or damaged.
std::optional<std::string> read_member(const std::filesystem::path& archive, const std::string& member);

}  // namespace pelage
