// Prepared meshes on disk: one file each, named by what it was made from, with a checksum.
#pragma once
#include <filesystem>
#include <optional>

#include "harness/mesh/mesh.hpp"

namespace pelage {

/// $XDG_CACHE_HOME/pelage, else ~/.cache/pelage, else a folder among the temporary files.
std::filesystem::path cache_folder();

std::string encode(const Mesh& mesh);
/// Empty when the bytes are not exactly what encode() once gave: torn, damaged or of another version.
std::optional<Mesh> decode(std::string_view bytes);

/// The mesh in `file`; empty when there is none or it is damaged.
std::optional<Mesh> read_cached(const std::filesystem::path& file);
/// Written beside and moved into place, so that no reader ever sees half of it. False when that was not
/// possible (a full disk, a read-only folder): the mesh is still good, only slower the next time.
bool write_cached(const std::filesystem::path& file, const Mesh& mesh);

}  // namespace pelage
