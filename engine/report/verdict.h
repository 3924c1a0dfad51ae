#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace orthonav::engine {

/// What a report says first: how the operation ended, in one line, and what to look at. Plain text.
struct Verdict {
  enum class Kind { kDone, kDoneWithWarnings, kIncomplete };
  Kind kind = Kind::kIncomplete;
  std::string line;                   ///< "Operation completed with 1 warning: 2 of 2 screws ..."
  std::string counts;                 ///< the line's end: "2 of 2 screws placed; ..."
  std::vector<std::string> warnings;  ///< the gravest first: "L5 left: ..."
};

/// Of a report.json or a session's JSON. Says no more than was measured: where a truth is known, it
/// says against which; where none is, it counts the wires that were measured.
[[nodiscard]] Verdict verdict_of(const nlohmann::json& report);
/// Its class in the style of the page: "done", "warned" or "incomplete".
[[nodiscard]] const char* style_of(const Verdict& verdict);
/// The warnings as HTML; empty where there are none.
[[nodiscard]] std::string warnings_list(const Verdict& verdict);
/// The same as the first section of the page.
[[nodiscard]] std::string verdict_section(const nlohmann::json& report);

/// Whether the surgeon declared this screw of a report.json done.
[[nodiscard]] bool is_placed(const nlohmann::json& screw);
/// Whether its true errors are known, and whether both are within `report_limits.h`. A wire that
/// missed the bone has an angle error alone, and isn't on target.
[[nodiscard]] bool has_truth(const nlohmann::json& screw);
[[nodiscard]] bool is_on_target(const nlohmann::json& screw);

}  // namespace orthonav::engine
