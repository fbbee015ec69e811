#include "harness/record/identity.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "harness/hash.hpp"

namespace pelage {
namespace {

std::string shown(const Identity& identity, const std::string& part) {
  const auto found = identity.find(part);
  return found == identity.end() ? "absent" : found->second;
}

/// Returns the name of the part in messages. The hash of a kernel also depends on the files that it includes.
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

std::string tuning_hash(const std::map<std::string, int>& tuning) {
  std::string text;
  for (const auto& [axis, value] : tuning) text += fmt::format("{}={} ", axis, value);
  return Hash().text(text).hex();
}

std::string device_hash(const nlohmann::ordered_json& provenance) {
  if (!provenance.contains("device_name")) return {};
  nlohmann::ordered_json json;
  for (const char* key :
       {"platform", "platform_version", "device_name", "device_version", "driver", "compute_units", "lanes",
        "pocl_affinity", "environment", "usable_cores", "cpu_quota", "timer", "timer_resolution_ns"})
    if (const auto found = provenance.find(key); found != provenance.end()) json[key] = *found;
  return Hash().text(json_line(json)).hex();
}

std::string json_line(const nlohmann::ordered_json& value) {
  return value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string renderer_hash(const std::string& renderer) {
  const char* threads = std::getenv("LP_NUM_THREADS");
  return Hash().text(renderer).text(threads ? threads : "").hex();
}

std::uint32_t check_seed(const std::string& case_name) {
  return std::uint32_t(Hash().text(case_name).value());
}

}  // namespace pelage
