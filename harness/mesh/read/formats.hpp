// The readers of the mesh formats. Each returns the points and polygons of a file. If `with_uv` is true and
// the file has UV positions, it returns them too, and refuses errors in them. `name` is the file in messages.
// All throw InputError, whose message has the line of the first error if the file is text.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/mesh/read/soup.hpp"

namespace pelage::detail {

/// Returns the bytes without a byte order mark. Throws InputError if they are UTF-16 text.
std::string_view text_of(std::string_view bytes, const std::string& name);

/// Wavefront OBJ.
Soup read_obj(std::string_view bytes, const std::string& name, bool with_uv);

/// The lines (`l`) of a Wavefront OBJ file, in place of its faces.
Soup read_obj_lines(std::string_view bytes, const std::string& name);

/// Geomview's OFF, COFF, NOFF and STOFF in text form.
Soup read_off(std::string_view bytes, const std::string& name, bool with_uv);

/// PLY in text or binary form: vertices, faces and triangle strips, UV of vertices or of corners.
Soup read_ply(std::string_view bytes, const std::string& name, bool with_uv);

/// STL in text or binary form, which has no UV.
Soup read_stl(std::string_view bytes, const std::string& name);

/// glTF 2.0, .gltf or .glb, with tinygltf. Reads the triangles of the default scene.
Soup read_gltf(const std::string& bytes, const std::filesystem::path& file, bool with_uv);

/// 3DS. Its z axis, which points up, becomes the y axis.
Soup read_3ds(std::string_view bytes, const std::string& name, bool with_uv);

/// The JSON text and the binary content of a glTF file.
struct GltfParts {
  std::string_view json, binary;
};

/// Returns the parts of a binary file (.glb): after a header of 12 bytes, each has its length, its type and
/// its content. The parts of a text file (.gltf) are its text and nothing. `name` is the file in messages.
GltfParts gltf_parts(std::string_view bytes, const std::string& name);

/// Returns the paths of the files to which a glTF file (.gltf or .glb) refers: first the buffers, then the
/// pictures, each in the order in which the glTF file lists them. Data URIs are left out. The list is empty
/// if `file` has neither the extension .gltf nor .glb, or if its text is not JSON. read_gltf() reports the
/// invalid JSON later. Throws InputError if a URI is absolute, leads out of the folder of `file`, or does not
/// refer to a regular file.
std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& file);
/// Returns the paths to which a glTF file with the content `bytes` refers. This function does not read
/// `file`. URIs are relative to the folder of `file`.
std::vector<std::filesystem::path> gltf_files(std::string_view bytes, const std::filesystem::path& file);

}  // namespace pelage::detail
