#include "engine/session/resuming.h"

#include <algorithm>
#include <utility>

#include "engine/session/operation_json.h"

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

/// If the references had moved in World, everything restored would be misplaced in the patient.
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

/// A registration comes with the points it was computed from, unless its level is finished.
void restore_level(LevelState& level, const LoggedLevel& logged) {
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

}  // namespace

Status Resuming::restore(const LoggedOperation& logged, OperationInWork& work,
                         RodTemplating& rods) {
  if (Status same = check_levels(work.levels, logged); !same) {
    return same;
  }
  const nav::Anchor* anchor = work.tools.tracker().anchor();
  if (anchor != nullptr) {
    if (Status same = check_places(anchor->places, logged.references); !same) {
      return same;
    }
  }
  LoggedOperation left = logged;
  if (anchor == nullptr || anchor->places.empty()) {
    left.forget_places();
  }
  regions_.clear();
  for (std::size_t i = 0; i < work.levels.size(); ++i) {
    restore_level(work.levels[i], left.levels[i]);
    regions_.push_back(left.levels[i].regions);
  }
  rods.restore({left.rods[0].done, left.rods[1].done});
  resumed_ = true;
  return {};
}

std::optional<Event> Resuming::go_on(OperationInWork& work, SessionSteps& steps, Timestamp time) {
  LevelState& level = work.level();
  if (!resumed_) {
    return std::nullopt;
  }
  for (const LevelState& earlier : work.levels) {
    if (!told_finished_ && earlier.finished() && earlier.registration) {
      work.observer->registration_restored(time, earlier);
    }
  }
  told_finished_ = true;
  if (level.finished()) {
    return steps.rods.left_to_do() ? Event::kNoScrewLeft : Event::kNoRodPlanned;
  }
  if (!level.unverified || !level.registration) {
    if (work.level_in_work < regions_.size()) {
      steps.digitizing.restore(std::exchange(regions_[work.level_in_work], {}));
    }
    return std::nullopt;
  }
  const bool landmark_tells = level.accepted && work.anchored() && work.options.steps.landmark &&
                              level.landmark.has_value();
  level.accepted = landmark_tells;
  work.observer->registration_restored(time, level);
  if (!landmark_tells) {
    return Event::kRegistrationRestored;
  }
  // If the landmark has moved, its registration is verified again.
  steps.verifying = Verifying(work, time);
  return Event::kAcceptanceRestored;
}

}  // namespace orthonav::engine
