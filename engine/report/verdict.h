#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace orthonav::engine {

/// The headline of a report: how the operation ended, in one line, and the warnings. Plain text.
struct Verdict {
  enum class Kind { kDone, kDoneWithWarnings, kIncomplete };
  Kind kind = Kind::kIncomplete;
  std::string line;                   ///< "Operation completed with 1 warning: 2 of 2 screws ..."
  std::string counts;                 ///< the line's end: "2 of 2 screws placed; ..."
  std::vector<std::string> warnings;  ///< the most serious first: "L5 left: ..."
};

/// From a report.json or a session's JSON. Claims no more than was measured: if a truth is known,
/// it is named; if not, the measured wires are counted.
[[nodiscard]] Verdict verdict_of(const nlohmann::json& report);
/// Its class in the style of the page: "done", "warned" or "incomplete".
[[nodiscard]] const char* style_of(const Verdict& verdict);
/// The warnings as HTML; empty where there are none.
[[nodiscard]] std::string warnings_list(const Verdict& verdict);
/// The same as the first section of the page.
[[nodiscard]] std::string verdict_section(const nlohmann::json& report);

/// Whether the surgeon declared this screw of a report.json done.
[[nodiscard]] bool is_placed(const nlohmann::json& screw);
/// Whether its true errors are known, and whether both are within the limits in `report_limits.h`.
/// A wire that missed the bone has only an angle error and isn't on target.
[[nodiscard]] bool has_truth(const nlohmann::json& screw);
[[nodiscard]] bool is_on_target(const nlohmann::json& screw);

}  // namespace orthonav::engine
