#include <fmt/format.h>

#include <bit>

#include "harness/atomic_file.hpp"
#include "harness/mesh/mesh.hpp"

namespace pelage {

static_assert(std::endian::native == std::endian::little, "write_ply requires a little-endian host");

void write_ply(const std::filesystem::path& file, const Mesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment {} {}\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nproperty float s\nproperty float t\nelement face {}\nproperty list uchar int vertex_indices\n"
      "end_header\n",
      mesh.name, mesh.hash, mesh.position.size(), mesh.triangle.size());
  const auto put = [&](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  for (std::size_t i = 0; i < mesh.position.size(); ++i) put(&mesh.position[i], 12), put(&mesh.uv[i], 8);
  for (const glm::uvec3& t : mesh.triangle) {
    bytes.push_back(3);
    put(&t, 12);
  }
  write_text_atomically(file, bytes);
}

}  // namespace pelage
