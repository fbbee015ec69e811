#include "harness/measure/gpu_state.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <vector>

#include "harness/isolated/isolated.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

std::optional<double> number_of(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str()) return {};
  return value;
}

std::optional<double> number_in(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line)) return {};
  return number_of(line);
}

/// The clock that a file of amdgpu marks with an asterisk, as in "1: 1500Mhz *", MHz.
std::optional<double> chosen_clock(const fs::path& file) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    if (const std::size_t colon = line.find(':');
        line.find('*') != std::string::npos && colon != std::string::npos)
      return number_of(line.substr(colon + 1));
  return {};
}

void put_number(nlohmann::ordered_json& json, const char* key, std::optional<double> value) {
  if (value) json[key] = *value;
}

}  // namespace

nlohmann::ordered_json gpu_state_of_nvidia(const std::string& text, const std::string& name) {
  nlohmann::ordered_json json;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> words;
    std::istringstream parts(line);
    for (std::string word; std::getline(parts, word, ',');)
      words.push_back(word.substr(std::min(word.find_first_not_of(' '), word.size())));
    if (words.size() != 5 || words[0] != name) continue;
    put_number(json, "core_mhz", number_of(words[1]));
    put_number(json, "memory_mhz", number_of(words[2]));
    put_number(json, "celsius", number_of(words[3]));
    if (words[4].starts_with("0x")) json["slowed"] = std::strtoull(words[4].c_str(), nullptr, 16);
    return json;
  }
  return json;
}

nlohmann::ordered_json gpu_state_of_card(const fs::path& card) {
  nlohmann::ordered_json json;
  auto core = chosen_clock(card / "device/pp_dpm_sclk");
  if (!core) core = number_in(card / "gt_act_freq_mhz");
  put_number(json, "core_mhz", core);
  put_number(json, "memory_mhz", chosen_clock(card / "device/pp_dpm_mclk"));
  std::error_code error;
  for (const auto& sensor : fs::directory_iterator(card / "device/hwmon", error))
    if (const auto thousandths = number_in(sensor.path() / "temp1_input"))
      json["celsius"] = *thousandths / 1000;
  return json;
}

nlohmann::ordered_json gpu_state(const cl::DeviceInfo& device) {
  if (!device.gpu) return {};
  if (on_path("nvidia-smi")) {
    const ProgramOutcome found = run_program({"nvidia-smi", nvidia_query, "--format=csv,noheader,nounits"});
    if (found.code == 0)
      if (const auto json = gpu_state_of_nvidia(found.messages, device.name); !json.empty()) return json;
  }
  std::error_code error;
  std::vector<fs::path> cards;
  for (const auto& entry : fs::directory_iterator("/sys/class/drm", error))
    if (const std::string name = entry.path().filename();
        name.starts_with("card") && name.find('-') == name.npos)
      cards.push_back(entry.path());
  std::ranges::sort(cards);
  for (const fs::path& card : cards)
    if (const auto json = gpu_state_of_card(card); !json.empty()) return json;
  return {};
}

}  // namespace pelage
