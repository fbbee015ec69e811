#include "harness/record/row.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "harness/record/contradiction.hpp"
#include "harness/record/ratios.hpp"

namespace pelage {
namespace {

using Json = nlohmann::ordered_json;

/// The texts of the values of Status, in the same order.
constexpr std::array<std::string_view, 6> kStatus{"ok",          "failed-check", "diverged",
                                                  "unsupported", "skipped",      "error"};

constexpr std::string_view kCrcMark = ",\"crc\":\"";

std::string checksum(std::string_view text) {
  const auto* bytes = reinterpret_cast<const Bytef*>(text.data());
  return fmt::format("{:08x}", crc32_z(0, bytes, text.size()));
}

/// Returns a JSON number if `text` is a number ("16" becomes 16), else a JSON string.
Json typed(const std::string& text) {
  Json parsed = Json::parse(text, nullptr, false);
  return parsed.is_number() && parsed.dump() == text ? parsed : Json(text);
}

Json object(const std::map<std::string, std::string>& values) {
  Json result = Json::object();
  for (const auto& [key, value] : values) result[key] = typed(value);
  return result;
}

std::map<std::string, std::string> strings(const Json& values) {
  std::map<std::string, std::string> result;
  for (const auto& [key, value] : values.items())
    result[key] = value.is_string() ? value.get<std::string>() : value.dump();
  return result;
}

/// Infinity and NaN become JSON strings, because JSON has no such numbers.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(fmt::format("{}", value));
}

double number(const Json& value) {
  return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

Json metric_json(const Metric& metric) {
  Json result{{"value", number(metric.value)}, {"unit", metric.unit}};
  if (!metric.relation.empty()) result["relation"] = metric.relation;
  if (metric.low) result["low"] = *metric.low;
  if (metric.high) result["high"] = *metric.high;
  return result;
}

Metric metric_from(const Json& json) {
  Metric result{number(json.at("value")), json.at("unit").get<std::string>()};
  result.relation = json.value("relation", "");
  if (json.contains("low")) result.low = json["low"].get<double>();
  if (json.contains("high")) result.high = json["high"].get<double>();
  return result;
}

/// Returns the value as a whole number of at least 0. Json::get() would convert 2.7 to 2, and a number above
/// the range of int to a wrong number.
int whole(const Json& json) {
  constexpr int most = std::numeric_limits<int>::max();
  if (!json.is_number_integer() || json.get<double>() < 0 || json.get<double>() > most)
    throw InputError(fmt::format("the row contains {} in place of a whole number of 0 to {}",
                                 json.dump().substr(0, 40), most));
  return json.get<int>();
}

/// Throws InputError if a value in the provenance has a wrong type. Only the keys that pelage reads are
/// checked.
void check_provenance(const Json& provenance) {
  if (!provenance.is_object()) throw InputError("the provenance of the row is not an object");
  const auto need = [&](const char* key, const char* type, auto&& is) {
    if (const auto found = provenance.find(key); found != provenance.end() && !is(*found))
      throw InputError(fmt::format("provenance.{} of the row is not {}", key, type));
  };
  for (const char* key : {"host", "preset", "shard_deal", "title", "utc"})
    need(key, "a text", [](const Json& value) { return value.is_string(); });
  need("converged", "true or false", [](const Json& value) { return value.is_boolean(); });
  for (const char* key : {"other_cpu_share", "precision", "started_s"})
    need(key, "a number", [](const Json& value) { return value.is_number(); });
}

constexpr int deepest = 32;  // largest permitted depth of nested JSON values in a row

/// Refuses deeply nested values, because copying and printing them would overflow the stack.
Json parsed(const std::string& text) {
  return Json::parse(text, [](int depth, Json::parse_event_t, const Json&) {
    if (depth > deepest)
      throw InputError(fmt::format("the row contains values that are nested more than {} deep", deepest));
    return true;
  });
}

Row row_from_json(const Json& json) {
  const int schema = whole(json.at("schema"));
  if (schema < 1 || schema > kRowSchema)
    throw NewerSchema(fmt::format("the row has schema {}; this version of pelage reads schemas 1 to {}",
                                  schema, kRowSchema));
  Row row;
  row.schema = schema;
  json.at("run_id").get_to(row.run_id);
  json.at("experiment").get_to(row.experiment);
  json.at("case").get_to(row.case_name);
  json.at("variant").get_to(row.variant);
  row.axes = strings(json.at("axes"));
  row.overrides = strings(json.at("overrides"));
  json.at("device").get_to(row.device);
  if (schema > 1) json.at("identity").get_to(row.identity);
  row.repeat = whole(json.at("repeat"));
  const auto status = json.at("status").get<std::string>();
  const auto found = std::ranges::find(kStatus, status);
  if (found == kStatus.end()) throw InputError(fmt::format("unknown status '{}'", status));
  row.status = Status(found - kStatus.begin());
  json.at("reason").get_to(row.reason);
  for (const Json& check : json.at("check"))
    row.check.push_back({check.at("against"), check.at("metric"), number(check.at("value")),
                         number(check.at("limit")), check.at("sense") == ">="});
  for (const auto& [phase, lists] : json.at("samples").items())
    row.samples[phase] = {lists.at("event_ms").get<std::vector<double>>(),
                          lists.at("wall_ms").get<std::vector<double>>(),
                          lists.value("cpu_ms", std::vector<double>())};
  for (const auto& [name, metric] : json.at("metrics").items()) row.metrics[name] = metric_from(metric);
  json.at("build_ms").get_to(row.build_ms);
  json.at("first_launch_ms").get_to(row.first_launch_ms);
  for (const auto& [axis, value] : json.at("tuning").items()) row.tuning[axis] = whole(value);
  json.at("image_hash").get_to(row.image_hash);
  row.provenance = json.at("provenance");
  check_provenance(row.provenance);
  if (schema < kRowSchema) convert_to_present(row);
  refuse_contradiction(row);
  return row;
}

}  // namespace

std::string_view to_text(Status status) {
  return kStatus.at(std::size_t(status));
}

std::string row_key(const Row& row) {
  std::string key = fmt::format("{}|{}|{}|{}", row.experiment, row.case_name, row.variant, row.repeat);
  for (const auto& [name, value] : row.overrides) key += fmt::format("|{}={}", name, value);
  return key;
}

std::string to_line(const Row& row) {
  Json check = Json::array();
  for (const Check& c : row.check)
    check.push_back({{"against", c.against},
                     {"metric", c.metric},
                     {"value", number(c.value)},
                     {"limit", number(c.limit)},
                     {"sense", c.at_least ? ">=" : "<="}});
  Json samples = Json::object();
  for (const auto& [phase, lists] : row.samples) {
    samples[phase] = {{"event_ms", lists.event_ms}, {"wall_ms", lists.wall_ms}};
    if (!lists.cpu_ms.empty()) samples[phase]["cpu_ms"] = lists.cpu_ms;
  }
  Json metrics = Json::object();
  for (const auto& [name, metric] : row.metrics) metrics[name] = metric_json(metric);

  Json json{{"schema", row.schema},
            {"run_id", row.run_id},
            {"experiment", row.experiment},
            {"case", row.case_name},
            {"variant", row.variant},
            {"axes", object(row.axes)},
            {"overrides", object(row.overrides)},
            {"device", row.device},
            {"repeat", row.repeat},
            {"status", to_text(row.status)},
            {"reason", row.reason},
            {"check", check},
            {"samples", samples},
            {"metrics", metrics},
            {"build_ms", row.build_ms},
            {"first_launch_ms", row.first_launch_ms},
            {"tuning", Json(row.tuning)},
            {"image_hash", row.image_hash},
            {"provenance", row.provenance}};
  if (row.schema > 1) json["identity"] = row.identity;
  std::string body = json_line(json);
  body.pop_back();
  return fmt::format("{}{}{}\"}}", body, kCrcMark, checksum(body));
}

Row row_from_line(std::string_view line) {
  const std::size_t mark = line.rfind(kCrcMark);
  if (mark == std::string_view::npos || line.size() != mark + kCrcMark.size() + 8 + 2 ||
      !line.ends_with("\"}"))
    throw InputError("the row does not end with a checksum");
  const std::string_view body = line.substr(0, mark);
  if (line.substr(mark + kCrcMark.size(), 8) != checksum(body))
    throw InputError("the checksum does not match the row");
  try {
    return row_from_json(parsed(std::string(body) + "}"));
  } catch (const std::logic_error& error) {  // std::stod
    throw InputError(fmt::format("the row contains a text in place of a number: {}", error.what()));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("this line is not a row: {}", error.what()));
  }
}

std::string value_at(const std::map<std::string, std::string>& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? std::string{} : found->second;
}

std::string provenance_text(const Row& row, const char* key) {
  const auto found = row.provenance.find(key);
  return found != row.provenance.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::optional<double> provenance_number(const Row& row, const char* key) {
  const auto found = row.provenance.find(key);
  if (found == row.provenance.end() || !found->is_number()) return {};
  return found->get<double>();
}

std::vector<double> frame_ms(const Row& row) {
  const auto found = row.samples.find("frame");
  return row.status == Status::ok && found != row.samples.end() ? found->second.wall_ms
                                                                : std::vector<double>{};
}

const std::vector<double>& times_of(const Row& row, const std::string& phase) {
  static const std::vector<double> none;
  const auto found = row.samples.find(phase);
  if (found == row.samples.end()) return none;
  return found->second.wall_ms.empty() ? found->second.event_ms : found->second.wall_ms;
}

}  // namespace pelage
