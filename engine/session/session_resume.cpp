#include <algorithm>
#include <utility>

#include "engine/session/operation_json.h"
#include "engine/session/session.h"

namespace orthonav::engine {
namespace {

Status check_levels(std::span<const LevelState> levels, const LoggedOperation& logged) {
  if (levels.size() != logged.levels.size()) {
    return Error{"the log has " + std::to_string(logged.levels.size()) + " levels, the operation " +
                 std::to_string(levels.size())};
  }
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (levels[i].plan.label != logged.levels[i].label ||
        levels[i].plan.screws.size() != logged.levels[i].screws.size()) {
      return Error{"level " + levels[i].plan.label + ": the log has " + logged.levels[i].label +
                   " with " + std::to_string(logged.levels[i].screws.size()) + " screws"};
    }
  }
  return {};
}

/// With references elsewhere in World, everything restored would be elsewhere in the patient.
Status check_places(std::span<const nav::ReferencePlace> places,
                    std::span<const nav::ReferencePlace> logged) {
  const bool same =
      std::equal(places.begin(), places.end(), logged.begin(), logged.end(),
                 [](const nav::ReferencePlace& a, const nav::ReferencePlace& b) {
                   return a.tool == b.tool && a.anchored_from_marker == b.anchored_from_marker;
                 });
  return same ? Status{} : Error{"the patient references are not placed as the log has them"};
}

void restore_screws(LevelState& level, const LoggedLevel& logged) {
  for (std::size_t i = 0; i < logged.screws.size(); ++i) {
    const LoggedScrew& screw = logged.screws[i];
    level.plan.screws[i] = screw.plan;
    level.earlier_plans[i] = screw.earlier;
    level.redone[i] = screw.redone;
    level.screw_done[i] = screw.done;
    level.executed[i] = screw.executed;
    level.clearance_at_depth[i] = screw.clearance;
    level.wires[i] = {screw.wire_asked, screw.wire};
  }
}

}  // namespace

Status Session::resume(const LoggedOperation& logged) {
  if (step_ != Step::kSetup || map_epoch_) {
    return Error{"an operation is resumed before its first step"};
  }
  if (Status same = check_levels(levels_, logged); !same) {
    return same;
  }
  const nav::Anchor* anchor = tools_.tracker().anchor();
  if (anchor != nullptr) {
    if (Status same = check_places(anchor->places, logged.references); !same) {
      return same;
    }
  }
  LoggedOperation left = logged;
  if (anchor == nullptr || anchor->places.empty()) {
    left.forget_places();
  }
  restored_regions_.clear();
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    restore_level(levels_[i], left.levels[i]);
    restored_regions_.push_back(left.levels[i].regions);
  }
  rod_templating_.restore({left.rods[0].done, left.rods[1].done});
  resumed_ = true;
  return {};
}

/// A registration comes with the points it was computed from, unless its level is finished.
void Session::restore_level(LevelState& level, const LoggedLevel& logged) const {
  level.attempts = logged.attempts;
  restore_screws(level, logged);
  level.map_moved = logged.finished() && logged.registration.has_value();
  const std::vector<Point<World>> points = logged.points();
  const bool whole = hash_of(points) == logged.points_hash;
  if (!logged.registration || !(whole || level.map_moved)) {
    return;
  }
  level.registration = logged.registration;
  level.predicted = nav::predicted_errors(*logged.registration, level.plan.screws);
  if (whole) {
    level.newest = RegistrationAttempt{points, *logged.registration};
  }
  level.landmark = logged.landmark;
  level.accepted = logged.accepted;
  level.unverified = true;
}

/// After "start", and when a level begins: to the step that the operation had reached, or to the
/// one before it in which its registration can be verified.
void Session::go_on(Timestamp time) {
  LevelState& now = level();
  if (now.finished()) {
    return handle(rod_templating_.left_to_do() ? Event::kNoScrewLeft : Event::kNoRodPlanned, time);
  }
  if (!now.unverified || !now.registration) {
    if (level_ < restored_regions_.size()) {
      digitizing_.restore(std::exchange(restored_regions_[level_], {}));
    }
    return;
  }
  const bool landmark_tells =
      now.accepted && anchored() && options_.steps.landmark && now.landmark.has_value();
  if (!landmark_tells) {
    now.accepted = false;
    return handle(Event::kRegistrationRestored, time);
  }
  // Should the landmark have moved, its registration is verified once more.
  verifying_ = Verifying(now, method_.verification, options_, anchored(), time);
  handle(Event::kAcceptanceRestored, time);
}

}  // namespace orthonav::engine
