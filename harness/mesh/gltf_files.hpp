// Finds the files to which a glTF file refers.
#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

namespace pelage::detail {

/// Returns the paths of the files to which a glTF file (.gltf or .glb) refers: first the buffers, then the
/// pictures, each in the order in which the glTF file lists them. Data URIs are left out. The list is empty
/// if `file` has neither the extension .gltf nor .glb, or if its text is not JSON. Assimp reports the invalid
/// JSON later, when it reads the file. Throws InputError if a URI is absolute, leads out of the folder of
/// `file`, or does not refer to a regular file.
std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& file);

/// Returns the paths to which a glTF file with the content `bytes` refers. This function does not read
/// `file`. URIs are relative to the folder of `file`.
std::vector<std::filesystem::path> gltf_files(std::string_view bytes, const std::filesystem::path& file);

}  // namespace pelage::detail
