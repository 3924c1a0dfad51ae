#include "engine/report/paper_table.h"

#include <nlohmann/json.hpp>

namespace orthonav::engine {

std::vector<double> values_of(const nlohmann::json& report, const PaperRow& row) {
  std::vector<double> values;
  const std::string key(row.key);
  const auto take = [&](const nlohmann::json& object) {
    if (object.is_object() && object.contains(key) && object[key].is_number()) {
      values.push_back(object[key].get<double>());
    }
  };
  for (const auto& level : report.at("levels")) {
    if (!level.is_object()) {
      continue;
    }
    if (!row.per_screw) {
      take(level);
    }
    if (row.per_screw && level.contains("screws") && level["screws"].is_array()) {
      for (const auto& screw : level["screws"]) {
        take(screw);
      }
    }
  }
  return values;
}

}  // namespace orthonav::engine
