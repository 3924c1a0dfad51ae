#include "engine/case/case.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/length_text.h"
#include "engine/case/operation.h"

namespace orthonav::engine {
namespace {

constexpr double kMaxEntryOffBone_m = 0.010;
/// A tip may stand out of the front by its radius, or by this where the plan states less.
constexpr double kMinTargetOutside_m = 0.003;
/// Centres of neighbouring lumbar vertebrae lie 30 mm and more apart; closer ones intersect.
constexpr double kMinLevelSpacing_m = 0.015;

/// What tells that a screw is not of this bone, or is written in other axes; +x left, +y posterior.
std::optional<std::string> screw_problem(const nav::SurfaceIndex& bone, double middle_x_m,
                                         const nav::ScrewPlan& screw) {
  const std::string which = name_of(screw.side);
  const auto at_entry = bone.nearest(screw.entry.v);
  const double off_m = at_entry ? at_entry->distance_m : 1e3;
  if (off_m > kMaxEntryOffBone_m) {
    return which + " entry lies " + in_mm(off_m) + " off the bone, limit " +
           in_mm(kMaxEntryOffBone_m);
  }
  const double behind_m = screw.entry.v.y - screw.target.v.y;
  if (!(behind_m > 0.0)) {
    return which + " entry lies " + in_mm(-behind_m) +
           " in front of its target, must lie behind it (posterior)";
  }
  const auto at_target = bone.nearest(screw.target.v);
  const double outside_m =
      bone.contains(screw.target.v) || !at_target ? 0.0 : at_target->distance_m;
  const double limit_m = std::max(screw.radius_m, kMinTargetOutside_m);
  if (outside_m > limit_m) {
    return which + " target lies " + in_mm(outside_m) + " outside the bone, limit " +
           in_mm(limit_m);
  }
  const double left_m = screw.entry.v.x - middle_x_m;
  const bool there = screw.side == nav::Side::kLeft ? left_m > 0.0 : left_m < 0.0;
  if (!there) {
    return which + " entry lies " + in_mm(std::abs(left_m)) + " to the " +
           (left_m > 0.0 ? "left" : "right") + " of the bone's middle, must lie to the " + which;
  }
  return std::nullopt;
}

}  // namespace

Point<Spine> CaseLevel::centre_in_spine() const {
  return spine_from_vertebra * Point<Vertebra>{nav::bounds_of(mesh).centre()};
}

const CaseLevel* Case::find(const std::string& label) const {
  const auto found = std::find_if(levels.begin(), levels.end(),
                                  [&](const CaseLevel& level) { return level.label == label; });
  return found == levels.end() ? nullptr : &*found;
}

const CaseLevel* Case::overlapped_by(std::size_t index) const {
  const Point<Spine> centre = levels[index].centre_in_spine();
  for (std::size_t i = 0; i < index; ++i) {
    if ((levels[i].centre_in_spine() - centre).norm() < kMinLevelSpacing_m) {
      return &levels[i];
    }
  }
  return nullptr;
}

std::vector<std::string> Case::check() const {
  std::vector<std::string> problems;
  if (levels.empty()) {
    problems.push_back("levels is empty");
  }
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const CaseLevel& level = levels[i];
    const std::string which =
        level.label.empty() ? "levels[" + std::to_string(i) + "]" : level.label;
    if (level.label.empty()) {
      problems.push_back(which + " has no label");
    }
    if (!level.label.empty() && find(level.label) != &level) {
      problems.push_back("label " + level.label + " stands twice");
    }
    if (level.screws.empty()) {
      problems.push_back(which + " has no screws");
    }
    if (const CaseLevel* other = overlapped_by(i)) {
      problems.push_back(which + " lies in " + other->label + " (see spine_from_model)");
    }
    if (level.mesh.triangles.empty()) {
      problems.push_back(which + " has no surface");
      continue;
    }
    const nav::SurfaceIndex bone(level.mesh);
    const double middle_x_m = nav::bounds_of(level.mesh).centre().x;
    for (const nav::ScrewPlan& screw : level.screws) {
      if (const auto problem = screw_problem(bone, middle_x_m, screw)) {
        problems.push_back(which + " " + *problem);
      }
    }
  }
  return problems;
}

}  // namespace orthonav::engine
