#include "engine/session/replanned_screw.h"

#include <cmath>

#include "engine/case/screw_place.h"

namespace orthonav::engine {
namespace {

using Kind = ReplanRefusal::Kind;
using ChangedOrNot = std::variant<nav::ScrewPlan, ReplanRefusal>;

/// Tolerance for rounding, so that a move by exactly the limit is allowed.
constexpr double kLastBits = 1e-9;
/// Radii that differ by less are the same, apart from rounding in files.
constexpr double kSameRadius_m = 1e-6;

ReplanRefusal no_size(Kind kind, double diameter_m, double length_m) {
  ReplanRefusal refusal{kind};
  refusal.diameter_m = diameter_m;
  refusal.length_m = length_m;
  return refusal;
}

/// Applies each kind of change to a screw.
struct Changer {
  const nav::ScrewPlan& now;
  const nav::VertebraModel& bone;
  const ScrewSizes& sizes;

  ChangedOrNot operator()(const SetScrewSize& size) const {
    const double diameter_m = size.diameter_m.value_or(2.0 * now.radius_m);
    const double length_m = size.length_m.value_or(nav::screw_length_m(now));
    // A planned size that is not mentioned stays, listed or not.
    const bool of_both = size.diameter_m && size.length_m;
    const bool listed = of_both           ? sizes.has(diameter_m, length_m)
                        : size.diameter_m ? sizes.of_diameter(diameter_m) != nullptr
                                          : sizes.has_length(length_m);
    if (!listed) {
      return no_size(Kind::kNoSuchSize, size.diameter_m.value_or(0.0), size.length_m.value_or(0.0));
    }
    return nav::resized_screw(now, 0.5 * diameter_m, size.length_m.value_or(0.0));
  }
  ChangedOrNot operator()(const NextScrewSize& next) const {
    using Which = NextScrewSize::Which;
    const double diameter_m = 2.0 * now.radius_m;
    if (next.which == Which::kThicker || next.which == Which::kThinner) {
      if (!(diameter_m > 0.0)) {
        return ReplanRefusal{Kind::kNoDiameter};
      }
      const auto other_m = sizes.next_diameter_m(diameter_m, next.which == Which::kThicker);
      return other_m ? ChangedOrNot(nav::resized_screw(now, 0.5 * *other_m, 0.0))
                     : no_size(Kind::kLastSize, diameter_m, 0.0);
    }
    const double length_m = nav::screw_length_m(now);
    const auto other_m = sizes.next_length_m(diameter_m, length_m, next.which == Which::kLonger);
    return other_m ? ChangedOrNot(nav::resized_screw(now, 0.0, *other_m))
                   : no_size(Kind::kLastSize, 0.0, length_m);
  }
  ChangedOrNot operator()(const MoveScrew& move) const {
    if (!nav::directions_of(now)) {
      return ReplanRefusal{Kind::kNoDirections};
    }
    const auto moved = nav::moved_screw(now, move.part, move.direction, move.by_m, bone.surface(),
                                        bone.reachable_surface());
    return moved ? ChangedOrNot(*moved) : ReplanRefusal{Kind::kOffTheBone};
  }
  ChangedOrNot operator()(const TiltScrew& tilt) const {
    const auto tilted = nav::tilted_screw(now, tilt.direction, tilt.by_rad);
    return tilted ? ChangedOrNot(*tilted) : ReplanRefusal{Kind::kNoDirections};
  }
  /// Position and length are free within the limits; the diameter must be in the list or unchanged.
  ChangedOrNot operator()(const PlaceScrew& place) const {
    nav::ScrewPlan placed = now;
    placed.entry = place.entry;
    placed.target = place.target;
    if (place.radius_m > 0.0 && std::abs(place.radius_m - now.radius_m) > kSameRadius_m) {
      if (sizes.of_diameter(2.0 * place.radius_m) == nullptr) {
        return no_size(Kind::kNoSuchSize, 2.0 * place.radius_m, 0.0);
      }
      placed.radius_m = place.radius_m;
    }
    if (ill_sized(placed.entry, placed.target, placed.radius_m)) {
      return ReplanRefusal{Kind::kIllSized};
    }
    if (misplaced(bone.surface(), placed.entry, placed.target, placed.radius_m)) {
      return ReplanRefusal{Kind::kOffTheBone};
    }
    return placed;
  }
  /// Undoing is handled elsewhere.
  ChangedOrNot operator()(const UndoChange& /*undo*/) const { return now; }
};

std::optional<ReplanRefusal> too_far(const nav::ScrewPlan& changed,
                                     const nav::ScrewPlan& preoperative,
                                     const ReplanLimits& limits) {
  const double moved_m = (changed.entry - preoperative.entry).norm();
  if (!(moved_m <= limits.entry_m + kLastBits)) {
    return ReplanRefusal{Kind::kEntryTooFar, moved_m, limits.entry_m};
  }
  const double tilted_rad = nav::tilt_between_rad(preoperative, changed);
  if (!(tilted_rad <= limits.tilt_rad + kLastBits)) {
    return ReplanRefusal{Kind::kTiltTooFar, tilted_rad, limits.tilt_rad};
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> ReplanLimits::check() const {
  std::vector<std::string> problems;
  if (!(entry_m >= 0.0 && entry_m <= 0.02)) {
    problems.push_back("entry_m must lie in [0, 0.02]");
  }
  if (!(tilt_rad >= 0.0 && tilt_rad <= 0.5)) {
    problems.push_back("tilt_rad must lie in [0, 0.5]");
  }
  for (const std::string& problem : sizes.check()) {
    problems.push_back("screw sizes: " + problem);
  }
  return problems;
}

ChangedOrNot changed(const Replan& replan, const nav::ScrewPlan& now,
                     const nav::ScrewPlan& preoperative, const nav::VertebraModel& bone,
                     const ReplanLimits& limits) {
  ChangedOrNot made = std::visit(Changer{now, bone, limits.sizes}, replan);
  if (const auto* screw = std::get_if<nav::ScrewPlan>(&made)) {
    if (const auto refusal = too_far(*screw, preoperative, limits)) {
      return *refusal;
    }
  }
  return made;
}

}  // namespace orthonav::engine
