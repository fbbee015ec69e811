// The header of an OpenEXR file, checked before OpenEXR reads it.
#pragma once
#include <filesystem>

namespace pelage {

/// Throws InputError if the file `path` begins as an OpenEXR file and an attribute of its header is larger
/// than the rest of the file, or if the file ends inside the header. OpenEXR allocates the number of bytes
/// that an attribute states before it reads the attribute, so a damaged file of 53 bytes could make it
/// allocate 2 GB.
void require_exr_header(const std::filesystem::path& path);

}  // namespace pelage
