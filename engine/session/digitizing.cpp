#include "engine/session/digitizing.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace orthonav::engine {
namespace {

/// A saved region goes when "delete" is said twice within this time.
constexpr Duration kSaidTwiceWithin = std::chrono::seconds(5);

}  // namespace

Message message_about(const RegistrationOutcome& outcome) {
  RegistrationRefused refused;
  refused.error = outcome.error;
  if (outcome.result) {
    refused.reasons = outcome.result->reasons;
    refused.stroke_next = outcome.result->stroke_next;
    refused.another_level_fits = !outcome.result->fits_better.empty();
  }
  return refused;
}

Digitizing::Digitizing(const Method& method, const SessionOptions& options)
    : verification_(method.verification), options_(options) {
  if (method.coaching) {
    coach_ = std::make_unique<Coach>(method.registrar, options.common);
  }
}

void Digitizing::press(LevelState& level, Timestamp time) {
  strokes_.digitizer.press(time);
  if (!level.first_press) {
    level.first_press = time;
  }
}

void Digitizing::collect(const nav::TrackedPose& pose, const nav::ToolGeometry& pointer) {
  if (strokes_.digitizer.recording()) {
    strokes_.digitizer.add(pose, pointer.tip_in_marker, pointer.axis_in_marker);
  }
}

void Digitizing::watch_work(WorkWatch* watch) {
  if (coach_) {
    coach_->watch(watch);
  }
}

void Digitizing::coach(const OperatedLevel& plan) {
  if (coach_) {
    coach_->step(plan, regions());
  }
}

Message Digitizing::drop_region(Timestamp time) {
  std::optional<nav::Region> gone = strokes_.digitizer.drop();
  const bool asked =
      std::exchange(strokes_.asked_to_drop_saved, std::nullopt) >= time - kSaidTwiceWithin;
  if (!gone && asked) {
    gone = strokes_.digitizer.drop_saved();
  }
  if (gone) {
    // It fades instead of vanishing.
    strokes_.dropped = {std::move(*gone), time};
    return {};
  }
  // One word too many must not cost a good region.
  const auto drawn = regions();
  const auto last =
      std::find_if(drawn.rbegin(), drawn.rend(), [](const nav::Region& r) { return r.saved; });
  if (last == drawn.rend()) {
    return NothingToDelete{NothingToDelete::What::kRegion};
  }
  strokes_.asked_to_drop_saved = time;
  return ConfirmDelete{last->samples.size()};
}

RegistrationOutcome Digitizing::register_level(LevelState& level, const Registrar& registrar,
                                               Timestamp time) {
  nav::Digitizer& digitizer = strokes_.digitizer;
  digitizer.release(time);
  // What is not saved is not registered: the two clicks that ask for it are no strokes.
  digitizer.drop();
  ++level.attempts;
  // The trial under way has lost its use, and this one shall have the machine to itself.
  forget_coaching();
  const std::vector<Point<World>> points = digitizer.saved_points();
  const std::vector<double> sds_m = digitizer.saved_point_sds_m();
  const std::vector<Vec3> shafts = digitizer.saved_shafts();
  nav::CommonErrors common = options_.common;
  common.map_m =
      std::hypot(common.map_m, options_.drift_since_m(time - level.first_press.value_or(time)));
  const auto result = registrar(
      {*level.plan.model, points, level.plan.screws, level.plan.neighbours, common, sds_m, shafts});
  RegistrationOutcome outcome;
  level.newest.reset();
  if (!result) {
    outcome.error = result.error();
  } else {
    outcome.result = *result;
    outcome.provisional = result->provisional && verification_ == Verification::kByTouch;
    level.newest = RegistrationAttempt{points, *result};
  }
  if (outcome.passed()) {
    level.registration = *result;
    level.predicted = nav::predicted_errors(*result, level.plan.screws);
    level.digitization_s = level.first_press ? seconds(time - *level.first_press) : 0.0;
  } else if (result && coach_) {
    coach_->tell(coaching_from(*result), digitizer.saved_count());
  }
  return outcome;
}

void Digitizing::clear() {
  forget_coaching();
  // A region that was deleted a moment ago still fades.
  strokes_.digitizer = nav::Digitizer{};
}

void Digitizing::forget_map() {
  forget_coaching();
  strokes_ = Strokes{};
}

void Digitizing::forget_coaching() {
  if (coach_) {
    coach_->forget();
  }
}

const DroppedRegion* Digitizing::dropped(Timestamp display_time, Duration fade) const {
  const DroppedRegion& dropped = strokes_.dropped;
  const bool fading = !dropped.region.samples.empty() && display_time - dropped.dropped_at <= fade;
  return fading ? &dropped : nullptr;
}

StrokesSoFar Digitizing::state() const {
  StrokesSoFar strokes;
  for (const nav::Region& region : regions()) {
    strokes.points += region.samples.size();
  }
  strokes.coaching = coach_ && coach_->newest() ? &*coach_->newest() : nullptr;
  return strokes;
}

}  // namespace orthonav::engine
