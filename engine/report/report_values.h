#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orthonav::engine {

/// A figure of report.json: its key, and how it is displayed.
struct ReportQuantity {
  std::string_view name;
  std::string_view unit;
  std::string_view key;    ///< of a screw or of a level
  bool per_screw = false;  ///< otherwise of a level
};

/// A number of an object; nothing where it is absent or of another type.
[[nodiscard]] std::optional<double> value_of(const nlohmann::json& object, std::string_view key);
/// The same for people; a dash if it is absent.
[[nodiscard]] std::string figure(const nlohmann::json& object, std::string_view key, int decimals);
/// A text of an object; empty where it is absent or of another type.
[[nodiscard]] std::string text_in(const nlohmann::json& object, std::string_view key);
/// An object in an object; an empty one where it is absent or of another type.
[[nodiscard]] const nlohmann::json& object_in(const nlohmann::json& object, std::string_view key);
/// Whether it is there and true.
[[nodiscard]] bool is_true(const nlohmann::json& object, std::string_view key);

/// What stands in the bone once a screw is placed: "drill"; "trajectory" where it is unknown.
[[nodiscard]] std::string placed_tool(const nlohmann::json& report);

/// Of an operation of rods alone: its plan has no level.
[[nodiscard]] bool is_of_rods_alone(const nlohmann::json& report);

/// Calls `take(level, name, screw)` for every screw of a report, where the name is "L4 left".
void for_each_screw(const nlohmann::json& report,
                    const std::function<void(const nlohmann::json& level, const std::string& name,
                                             const nlohmann::json& screw)>& take);
/// Probabilities by grade as HTML, "A 97 %, B 3 %"; grades below half a percent are left out.
[[nodiscard]] std::string likely_grades(const nlohmann::json& probabilities);

/// `key` of every screw, or of every level, in a report; absent ones are left out.
[[nodiscard]] std::vector<double> values_of(const nlohmann::json& report, std::string_view key,
                                            bool per_screw);

}  // namespace orthonav::engine
