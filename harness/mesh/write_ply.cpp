#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "harness/error.hpp"
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
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    put(&mesh.position[i], 12);
    put(&mesh.uv[i], 8);
  }
  for (const glm::uvec3& t : mesh.triangle) {
    bytes.push_back(3);
    put(&t, 12);
  }
  const std::filesystem::path beside = fmt::format("{}.{}", file.string(), ::getpid());
  errno = 0;
  std::ofstream out(beside, std::ios::binary);
  out.write(bytes.data(), std::streamsize(bytes.size()));
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(beside, file, error);
  if (!out || error) {
    const std::string reason = error ? error.message() : std::strerror(errno);
    std::filesystem::remove(beside, error);
    throw InputError(fmt::format("{}: cannot be written: {}", file.string(), reason));
  }
}

}  // namespace pelage
