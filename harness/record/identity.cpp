#include "harness/record/identity.hpp"

#include <fmt/format.h>

#include "harness/hash.hpp"

namespace pelage {
namespace {

std::string shown(const Identity& identity, const std::string& part) {
  const auto found = identity.find(part);
  return found == identity.end() ? "absent" : found->second;
}

/// Returns the text that messages print for a part of an identity. For a kernel, the text mentions the files
/// that the kernel includes, because the hash of the kernel depends on them.
std::string label_of(const std::string& part) {
  return part.starts_with(kernel_part) ? part + " with its includes" : part;
}

}  // namespace

std::vector<std::string> differing_parts(const Identity& a, const Identity& b) {
  Identity all = a;
  all.insert(b.begin(), b.end());
  std::vector<std::string> parts;
  for (const auto& [part, unused] : all)
    if (shown(a, part) != shown(b, part)) parts.push_back(label_of(part));
  return parts;
}

std::vector<std::string> differences(const Identity& was, const Identity& is) {
  Identity all = was;
  all.insert(is.begin(), is.end());
  std::vector<std::string> texts;
  for (const auto& [part, unused] : all)
    if (shown(was, part) != shown(is, part))
      texts.push_back(fmt::format("{} was {}, is {}", label_of(part), shown(was, part), shown(is, part)));
  return texts;
}

std::string hash_of(const Identity& identity) {
  if (identity.empty()) return {};
  Hash hash;
  for (const auto& [part, content] : identity) hash.text(part).text(content);
  return hash.hex();
}

}  // namespace pelage
