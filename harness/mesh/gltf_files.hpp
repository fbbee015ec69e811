// The files that a glTF file names.
#pragma once
#include <filesystem>
#include <vector>

namespace pelage::detail {

/// Returns the files with the buffers and pictures of a glTF file (.gltf or .glb), in the order of the file;
/// data URIs are left out. Returns no file if the text is not JSON, because the importer reports this error.
/// Throws InputError if a URI is absolute, leads out of the folder of `file`, or names no regular file.
std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& file);

}  // namespace pelage::detail
