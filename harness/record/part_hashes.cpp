#include "harness/record/part_hashes.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "harness/hash.hpp"

namespace pelage {

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
        "pocl_affinity", "environment", "timer", "timer_resolution_ns"})
    if (const auto found = provenance.find(key); found != provenance.end()) json[key] = *found;
  // Bytes of driver strings that are not UTF-8 are replaced when a row is written. The hash must be computed
  // from strings with the same replacements.
  return Hash().text(json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)).hex();
}

std::string renderer_hash(const std::string& renderer) {
  const char* threads = std::getenv("LP_NUM_THREADS");
  return Hash().text(renderer).text(threads ? threads : "").hex();
}

std::uint32_t check_seed(const std::string& case_name) {
  return std::uint32_t(Hash().text(case_name).value());
}

}  // namespace pelage
