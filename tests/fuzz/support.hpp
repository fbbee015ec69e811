// Functions that several fuzz targets use.
#pragma once
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "harness/error.hpp"

namespace pelage::fuzz {

/// Calls a parser. The parser may throw InputError. Any other exception leaves this function; libFuzzer then
/// reports it as an error.
template <class Parse>
void may_refuse(Parse&& parse) {
  try {
    parse();
  } catch (const InputError& refusal) {
    if (std::string_view(refusal.what()).empty()) throw std::logic_error("an InputError without a message");
  }
}

/// Throws an exception if `holds` is false. libFuzzer reports this exception as an error.
inline void expect(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

/// A file in memory that contains the bytes of the input. It has a path, because some parsers need the path
/// of a file.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) : descriptor_(::memfd_create("fuzz", MFD_CLOEXEC)) {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t count = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
      if (count <= 0) std::abort();
      done += std::size_t(count);
    }
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace pelage::fuzz
