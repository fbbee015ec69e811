// The 64-bit FNV-1a hash. It identifies contents and detects damaged files; it is not a cryptographic hash.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace pelage {

class Hash {
 public:
  Hash& bytes(const void* data, std::size_t size) {
    const auto* byte = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ byte[i]) * 0x100000001b3u;
    return *this;
  }
  Hash& text(std::string_view value) { return number(value.size()).bytes(value.data(), value.size()); }
  Hash& number(std::uint64_t value) { return bytes(&value, sizeof value); }
  template <class T>
  requires std::is_trivially_copyable_v<T> Hash& values(const std::vector<T>& list) {
    return number(list.size()).bytes(list.data(), list.size() * sizeof(T));
  }
  std::uint64_t value() const { return value_; }
  std::string hex() const {  ///< 16 digits
    std::string digits(16, '0');
    for (int i = 0; i < 16; ++i) digits[15 - std::size_t(i)] = "0123456789abcdef"[(value_ >> (4 * i)) & 15];
    return digits;
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace pelage
