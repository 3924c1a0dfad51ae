#include "engine/report/report_values.h"

#include <nlohmann/json.hpp>
#include <string>

namespace orthonav::engine {

std::optional<double> value_of(const nlohmann::json& object, std::string_view key) {
  if (!object.is_object()) {
    return std::nullopt;
  }
  const auto found = object.find(std::string(key));
  return found != object.end() && found->is_number() ? std::optional(found->get<double>())
                                                     : std::nullopt;
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
