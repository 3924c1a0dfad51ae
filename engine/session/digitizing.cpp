#include "engine/session/digitizing.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "base/joined.h"
#include "engine/session/status_text.h"

namespace orthonav::engine {
namespace {

/// A saved region goes when "delete" is said twice within this time.
constexpr Duration kSaidTwiceWithin = std::chrono::seconds(5);

/// Why a registration does not count; empty when it does.
std::string refusal_of(const Result<nav::Registration>& result) {
  if (!result) {
    return result.error().message;
  }
  if (result->accepted) {
    return {};
  }
  const std::string reasons = joined(result->reasons);
  return reasons.empty() ? "registration not accepted" : reasons;
}

}  // namespace

std::string RegistrationOutcome::told() const {
  std::string advice;
  if (result) {
    advice = result->fits_better.empty() ? result->advice : "make sure of the level";
  }
  return "refused: " + refusal + (advice.empty() ? "" : "; " + advice);
}

Digitizing::Digitizing(const Method& method) {
  if (method.coaching) {
    coach_ = std::make_unique<Coach>(method.registrar);
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

void Digitizing::coach(const OperatedLevel& plan) {
  if (coach_) {
    coach_->step(plan, regions());
  }
}

std::string Digitizing::drop_region(Timestamp time) {
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
    return "nothing to delete";
  }
  strokes_.asked_to_drop_saved = time;
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "say delete again to drop the last saved %zu points",
                last->samples.size());
  return text.data();
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
  const auto result = registrar(
      {*level.plan.model, points, level.plan.screws, level.plan.neighbours, sds_m, shafts});
  RegistrationOutcome outcome;
  outcome.refusal = refusal_of(result);
  level.newest.reset();
  if (result) {
    outcome.result = *result;
    level.newest = RegistrationAttempt{points, *result};
  }
  if (outcome.refusal.empty()) {
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

void Digitizing::append_state(std::string& out) const {
  std::size_t points = 0;
  for (const nav::Region& region : regions()) {
    points += region.samples.size();
  }
  append_count(out, points);
  out += " points";
  if (coach_ && coach_->newest()) {
    out += " | ";
    append_text_of(out, *coach_->newest());
  }
}

}  // namespace orthonav::engine
