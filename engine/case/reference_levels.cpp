#include "engine/case/reference_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace orthonav::engine {
namespace {

/// From one vertebra's middle to the next, where the spine is largest.
constexpr double kPitch_m = 0.040;

using Spine = std::vector<SpineLevel>;

Spine::const_iterator named(const Spine& spine, const std::string& label) {
  return std::find_if(spine.begin(), spine.end(),
                      [&label](const SpineLevel& level) { return level.label == label; });
}

/// Both must be in the spine.
int levels_between(const Spine& spine, const std::string& one, const std::string& other) {
  const auto a = named(spine, one);
  const auto b = named(spine, other);
  const double by_height = std::abs(a->height_m - b->height_m) / kPitch_m;
  return std::max(static_cast<int>(std::abs(a - b)), static_cast<int>(std::lround(by_height)));
}

}  // namespace

Status check_references(const Operation& operation, const std::vector<nav::ToolGeometry>& tools) {
  std::vector<const nav::ToolGeometry*> references;
  for (const nav::ToolGeometry& tool : tools) {
    if (tool.role != nav::ToolRole::kReference || tool.level.empty()) {
      continue;
    }
    if (named(operation.spine, tool.level) == operation.spine.end()) {
      return Error{"reference '" + tool.name + "': clamped to '" + tool.level +
                   "', which is not a level of case '" + operation.case_name + "'"};
    }
    references.push_back(&tool);
  }
  for (const OperatedLevel& level : operation.levels) {
    int nearest = references.empty() ? 0 : std::numeric_limits<int>::max();
    const nav::ToolGeometry* on = nullptr;
    for (const nav::ToolGeometry* reference : references) {
      const int away = levels_between(operation.spine, level.label, reference->level);
      if (away < nearest) {
        nearest = away;
        on = reference;
      }
    }
    if (nearest > kFarthestReference) {
      return Error{"level '" + level.label + "': the nearest reference, '" + on->name + "' on " +
                   on->level + ", is " + std::to_string(nearest) + " vertebrae away, limit " +
                   std::to_string(kFarthestReference)};
    }
  }
  return {};
}

}  // namespace orthonav::engine
