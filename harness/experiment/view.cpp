#include "harness/experiment/view.hpp"

#include <nlohmann/json.hpp>

namespace pelage {
namespace {

constexpr std::pair<const char*, std::string View::*> texts[] = {{"x", &View::x},
                                                                 {"x_scale", &View::x_scale},
                                                                 {"y_scale", &View::y_scale},
                                                                 {"marks", &View::marks},
                                                                 {"program", &View::program}};

}  // namespace

nlohmann::json to_json(const View& view) {
  auto json = nlohmann::json::object();
  for (const auto& [name, member] : view_lists)
    if (!(view.*member).empty()) json[name] = view.*member;
  for (const auto& [name, member] : texts)
    if (!(view.*member).empty()) json[name] = view.*member;
  return json;
}

View view_from_json(const nlohmann::json& json) {
  View view;
  for (const auto& [name, member] : view_lists)
    if (const auto found = json.find(name); found != json.end() && found->is_array())
      for (const auto& item : *found)
        if (item.is_string()) (view.*member).push_back(item.get<std::string>());
  for (const auto& [name, member] : texts)
    if (const auto found = json.find(name); found != json.end() && found->is_string())
      view.*member = found->get<std::string>();
  return view;
}

}  // namespace pelage
