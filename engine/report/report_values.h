#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>
#include <vector>

namespace orthonav::engine {

/// A figure of report.json: where it stands, and how it is shown.
struct ReportQuantity {
  std::string_view name;
  std::string_view unit;
  std::string_view key;    ///< of a screw or of a level
  bool per_screw = false;  ///< otherwise of a level
};

/// A number of an object; nothing where it is absent or of another type.
[[nodiscard]] std::optional<double> value_of(const nlohmann::json& object, std::string_view key);

/// `key` of every screw, or of every level, in a report; absent ones are left out.
[[nodiscard]] std::vector<double> values_of(const nlohmann::json& report, std::string_view key,
                                            bool per_screw);

}  // namespace orthonav::engine
