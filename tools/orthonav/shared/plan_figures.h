#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/case/case.h"
#include "engine/case/screw_sizes.h"
#include "nav/planning/pedicle_screws.h"

namespace orthonav::tools {

/// A judged screw of a plan.
struct JudgedScrew {
  nav::ScrewPlan plan;
  std::optional<nav::Clearance> clearance;  ///< none: the plan states no radius
  bool listed = true;                       ///< its size is in the list of screws
  /// For a screw from `plan auto`: how it was found.
  std::optional<nav::PlannedScrew> found;

  /// Whether it leaves the bone without a stated reason.
  [[nodiscard]] bool breaks_through() const;
};

/// A side on which no screw could be planned.
struct RefusedSide {
  nav::Side side = nav::Side::kLeft;
  std::string reason;
};

struct JudgedLevel {
  std::string label;
  std::vector<JudgedScrew> screws;
  std::vector<RefusedSide> refused;
};

[[nodiscard]] JudgedScrew judged(const nav::SurfaceIndex& bone, const nav::ScrewPlan& screw,
                                 const engine::ScrewSizes& sizes);

/// Every screw of a level.
[[nodiscard]] JudgedLevel judged(const engine::CaseLevel& level, const engine::ScrewSizes& sizes);

/// "L4 left: breaks through the cortex: clearance -0.4 mm, limit 0.0 mm".
[[nodiscard]] std::string breach_text(const std::string& label, const JudgedScrew& screw);

/// Prints where a case was written, and each of its screws as `print` does.
void print_written(const std::string& folder, const engine::Case& subject,
                   const engine::ScrewSizes& sizes);

/// Prints one line per screw on standard output, lengths in mm and angles in degrees.
void print(const std::vector<JudgedLevel>& levels);

[[nodiscard]] nlohmann::ordered_json as_json(const std::vector<JudgedLevel>& levels);

}  // namespace orthonav::tools
