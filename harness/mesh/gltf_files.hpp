// Finds the files to which a glTF file refers.
#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

namespace pelage::detail {

/// Returns the paths of the files to which a glTF file (.gltf or .glb) refers: first the buffers, then the
/// pictures, each in the order in which the glTF file lists them. Data URIs are left out. If the text of the
/// glTF file is not JSON, the list is empty, because Assimp reports this error when it reads the file
/// afterwards. Throws InputError if a URI is absolute, leads out of the folder of `file`, or does not refer
/// to a regular file. Returns no paths for a file with another extension than .gltf and .glb.
std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& file);

/// Does the same for a glTF file whose content is `bytes`. URIs are relative to the folder of `file`.
std::vector<std::filesystem::path> gltf_files(std::string_view bytes, const std::filesystem::path& file);

}  // namespace pelage::detail
