#include "engine/report/report_values.h"

#include <nlohmann/json.hpp>

#include "engine/report/html_text.h"

namespace orthonav::engine {

namespace {

/// Null if the key is absent or the value is not an object.
const nlohmann::json* find_in(const nlohmann::json& object, std::string_view key) {
  if (!object.is_object()) {
    return nullptr;
  }
  const auto found = object.find(std::string(key));
  return found != object.end() ? &*found : nullptr;
}

}  // namespace

std::optional<double> value_of(const nlohmann::json& object, std::string_view key) {
  const nlohmann::json* const found = find_in(object, key);
  return found != nullptr && found->is_number() ? std::optional(found->get<double>())
                                                : std::nullopt;
}

std::string figure(const nlohmann::json& object, std::string_view key, int decimals) {
  const auto value = value_of(object, key);
  return value ? html_number(*value, decimals) : kNoValue;
}

std::string text_in(const nlohmann::json& object, std::string_view key) {
  const nlohmann::json* const found = find_in(object, key);
  return found != nullptr && found->is_string() ? found->get<std::string>() : std::string();
}

const nlohmann::json& object_in(const nlohmann::json& object, std::string_view key) {
  static const nlohmann::json kNone = nlohmann::json::object();
  const nlohmann::json* const found = find_in(object, key);
  return found != nullptr && found->is_object() ? *found : kNone;
}

bool is_true(const nlohmann::json& object, std::string_view key) {
  const nlohmann::json* const found = find_in(object, key);
  return found != nullptr && found->is_boolean() && found->get<bool>();
}

std::string placed_tool(const nlohmann::json& report) {
  const std::string instrument = text_in(report, "instrument");
  return instrument == "sleeved drill" || instrument == "robot arm" ? "drill"
         : instrument == "screw"                                    ? "screw"
         : instrument.empty()                                       ? "trajectory"
                                                                    : "wire";
}

bool is_of_rods_alone(const nlohmann::json& report) {
  const nlohmann::json* const levels = find_in(report, "levels");
  return levels != nullptr && levels->is_array() && levels->empty();
}

void for_each_screw(const nlohmann::json& report,
                    const std::function<void(const nlohmann::json& level, const std::string& name,
                                             const nlohmann::json& screw)>& take) {
  for (const nlohmann::json& level : report.value("levels", nlohmann::json::array())) {
    for (const nlohmann::json& screw : level.value("screws", nlohmann::json::array())) {
      take(level, text_in(level, "label") + " " + text_in(screw, "side"), screw);
    }
  }
}

std::string likely_grades(const nlohmann::json& probabilities) {
  std::string out;
  for (const auto& [grade, probability] : probabilities.items()) {
    const double percent = probability.is_number() ? 100.0 * probability.get<double>() : 0.0;
    if (percent >= 0.5) {
      out += (out.empty() ? "" : ", ") + html_escaped(grade) + " " + html_number(percent, 0) + " %";
    }
  }
  return out;
}

std::vector<double> values_of(const nlohmann::json& report, std::string_view key, bool per_screw) {
  std::vector<double> values;
  const auto take = [&](const nlohmann::json& object) {
    if (const auto value = value_of(object, key)) {
      values.push_back(*value);
    }
  };
  if (!report.is_object() || !report.contains("levels")) {
    return values;
  }
  for (const nlohmann::json& level : report["levels"]) {
    if (!per_screw) {
      take(level);
    } else if (level.is_object() && level.contains("screws") && level["screws"].is_array()) {
      for (const nlohmann::json& screw : level["screws"]) {
        take(screw);
      }
    }
  }
  return values;
}

}  // namespace orthonav::engine
