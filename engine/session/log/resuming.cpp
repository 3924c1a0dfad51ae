#include "engine/session/log/resuming.h"

#include <algorithm>
#include <utility>

#include "engine/session/log/operation_json.h"

namespace orthonav::engine {
namespace {

Status check_levels(std::span<const LevelState> levels, std::span<const LevelState> logged) {
  if (levels.size() != logged.size()) {
    return Error{"the log has " + std::to_string(logged.size()) + " levels, the operation " +
                 std::to_string(levels.size())};
  }
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (levels[i].plan.label != logged[i].plan.label ||
        levels[i].screws.size() != logged[i].screws.size()) {
      return Error{"level " + levels[i].plan.label + ": the log has " + logged[i].plan.label +
                   " with " + std::to_string(logged[i].screws.size()) + " screws"};
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

/// A registration comes with the points it was computed from, unless its level is finished.
void restore_level(LevelState& level, LevelState logged) {
  level.plan.screws = std::move(logged.plan.screws);
  logged.plan = std::move(level.plan);
  level = std::move(logged);
  level.map_moved = level.finished() && level.registration.has_value();
  if (!level.registration || !(level.newest || level.map_moved)) {
    return level.forget_registration();
  }
  level.predicted = nav::predicted_errors(*level.registration, level.plan.screws);
  level.unverified = true;
}

}  // namespace

Status Resuming::restore(const LoggedOperation& logged, SessionState& work, RodTemplating& rods) {
  if (Status same = check_levels(work.state.levels, logged.state.levels); !same) {
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
  for (std::size_t i = 0; i < work.state.levels.size(); ++i) {
    restore_level(work.state.levels[i], std::move(left.state.levels[i]));
  }
  strokes_ = std::move(left.strokes);
  for (std::size_t i = 0; i < left.state.rods.size(); ++i) {
    // It is not shown, and its places are not known.
    work.state.rods[i].done = work.state.rods[i].map_moved = left.state.rods[i].done;
  }
  rods.resume(work.state);
  resumed_ = true;
  return {};
}

std::optional<Event> Resuming::resume_level(SessionState& work, const RodTemplating& rods,
                                            Digitizing& digitizing, Verifying& verifying,
                                            Timestamp time) {
  LevelState& level = work.level();
  if (!resumed_) {
    return std::nullopt;
  }
  for (const LevelState& earlier : work.state.levels) {
    if (!told_finished_ && earlier.finished() && earlier.registration) {
      work.observer->registration_restored(time, earlier);
    }
  }
  told_finished_ = true;
  if (level.finished()) {
    return rods.left_to_do(work.state) ? Event::kNoScrewLeft : Event::kNoRodPlanned;
  }
  if (!level.unverified || !level.registration) {
    if (work.level_in_work < strokes_.size()) {
      digitizing.restore(std::exchange(strokes_[work.level_in_work], {}));
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
  verifying = Verifying(work, time, {});
  return Event::kAcceptanceRestored;
}

}  // namespace orthonav::engine
