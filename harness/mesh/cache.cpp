#include "harness/mesh/cache.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "harness/mesh/finish.hpp"
#include "harness/mesh/hash.hpp"

namespace pelage {
namespace {

constexpr std::string_view magic = "pelage mesh 1\n";

class Writer {
 public:
  template <class T>
  void value(const T& item) {
    out.append(reinterpret_cast<const char*>(&item), sizeof item);
  }
  template <class T>
  void list(const std::vector<T>& items) {
    value(std::uint64_t(items.size()));
    out.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
  }
  void text(const std::string& item) {
    value(std::uint64_t(item.size()));
    out += item;
  }
  std::string out;
};

// Every read says whether the bytes sufficed.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  bool value(T& item) {
    return take(&item, sizeof item);
  }
  template <class T>
  bool list(std::vector<T>& items) {
    std::uint64_t count = 0;
    if (!value(count) || count > rest_.size() / sizeof(T)) return false;
    items.resize(count);
    return take(items.data(), count * sizeof(T));
  }
  bool text(std::string& item) {
    std::uint64_t count = 0;
    if (!value(count) || count > rest_.size()) return false;
    item.resize(count);
    return take(item.data(), count);
  }
  bool done() const { return rest_.empty(); }

 private:
  bool take(void* target, std::size_t size) {
    if (size > rest_.size()) return false;
    if (size > 0) std::memcpy(target, rest_.data(), size);
    rest_.remove_prefix(size);
    return true;
  }
  std::string_view rest_;
};

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(std::size_t(written));
  }
  return true;
}

bool consistent(const Mesh& mesh) {
  const std::size_t copies = mesh.position.size();
  if (mesh.uv.size() != copies || mesh.weld.size() != copies) return false;
  for (const std::uint32_t point : mesh.weld)
    if (point >= mesh.welded) return false;
  for (const glm::uvec3& t : mesh.triangle)
    if (t.x >= copies || t.y >= copies || t.z >= copies) return false;
  return content_hash(mesh) == mesh.hash;
}

}  // namespace

std::filesystem::path cache_folder() {
  if (const char* folder = std::getenv("XDG_CACHE_HOME"); folder && *folder)
    return std::filesystem::path(folder) / "pelage";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::filesystem::path(home) / ".cache" / "pelage";
  return std::filesystem::temp_directory_path() / "pelage-cache";
}

std::string encode(const Mesh& mesh) {
  Writer to;
  to.out = magic;
  to.text(mesh.name);
  to.text(mesh.hash);
  to.list(mesh.position);
  to.list(mesh.uv);
  to.list(mesh.weld);
  to.list(mesh.triangle);
  to.value(mesh.welded);
  to.value(std::uint8_t(mesh.periodic_uv));
  to.value(mesh.length_per_uv);
  to.value(std::uint64_t(mesh.notes.size()));
  for (const std::string& note : mesh.notes) to.text(note);
  to.value(Hash().bytes(to.out.data(), to.out.size()).value());
  return std::move(to.out);
}

std::optional<Mesh> decode(std::string_view bytes) {
  std::uint64_t sum = 0;
  if (bytes.size() < magic.size() + sizeof sum || !bytes.starts_with(magic)) return {};
  std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
  bytes.remove_suffix(sizeof sum);
  if (Hash().bytes(bytes.data(), bytes.size()).value() != sum) return {};
  Reader from(bytes.substr(magic.size()));
  Mesh mesh;
  std::uint8_t periodic = 0;
  std::uint64_t notes = 0;
  if (!(from.text(mesh.name) && from.text(mesh.hash) && from.list(mesh.position) && from.list(mesh.uv) &&
        from.list(mesh.weld) && from.list(mesh.triangle) && from.value(mesh.welded) && from.value(periodic) &&
        from.value(mesh.length_per_uv) && from.value(notes)))
    return {};
  mesh.periodic_uv = periodic != 0;
  for (std::string note; notes > 0; --notes) {
    if (!from.text(note)) return {};
    mesh.notes.push_back(note);
  }
  if (!from.done() || !consistent(mesh)) return {};
  return mesh;
}

std::optional<Mesh> read_cached(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return decode(std::move(bytes).str());
}

bool write_cached(const std::filesystem::path& file, const Mesh& mesh) {
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  std::string beside = file.string() + ".XXXXXX";
  const int out = ::mkostemp(beside.data(), O_CLOEXEC);
  if (out < 0) return false;
  const bool written = write_all(out, encode(mesh)) && ::fchmod(out, 0644) == 0 && ::fsync(out) == 0;
  if (::close(out) != 0 || !written || ::rename(beside.c_str(), file.c_str()) != 0) {
    ::unlink(beside.c_str());
    return false;
  }
  return true;
}

}  // namespace pelage
