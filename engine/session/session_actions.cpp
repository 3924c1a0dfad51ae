#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "base/joined.h"
#include "engine/session/session.h"
#include "nav/registration/unstroked_surface.h"

namespace orthonav::engine {
namespace {

/// A saved region goes when "delete" is said twice within this time.
constexpr Duration kSaidTwiceWithin = std::chrono::seconds(5);

}  // namespace

void Session::act(Action action, Event event, Timestamp time) {
  switch (action) {
    case Action::kRefuse:
      say("not possible now: " + std::string(name_of(event)), time);
      return;
    case Action::kIgnore:
      return;
    case Action::kWarnLost:
      return;  // the status line shows it from `seen_`
    case Action::kHideGuidance:
      guidance_hidden_ = true;
      return;
    case Action::kShowGuidance:
      guidance_hidden_ = false;
      return;
    case Action::kCountRefusal:
      return;  // the reason was said where it arose
    case Action::kForgetMap:
      forget_map(time);
      return;
    case Action::kEndTouch:
      touching_ = false;
      return;  // the click that may follow uses the touch
    default:
      break;
  }
  message_.clear();
  act_on_regions(action, time);
  act_on_level(action, time);
  act_on_touch(action, time);
  act_on_checks(action, time);
  act_on_rod(action, time);
}

void Session::act_on_regions(Action action, Timestamp time) {
  switch (action) {
    case Action::kStartSampling:
      digitizer_.press(time);
      if (!level().first_press) {
        level().first_press = time;
      }
      return;
    case Action::kStopSampling:
      digitizer_.release(time);
      return;
    case Action::kSaveRegion:
      digitizer_.save();
      return;
    case Action::kDropRegion:
      drop_region(time);
      return;
    default:
      return;
  }
}

void Session::act_on_level(Action action, Timestamp time) {
  switch (action) {
    case Action::kBeginLevel:
      begin_level();
      return;
    case Action::kRegister:
      digitizer_.release(time);
      // What is not saved is not registered: the two clicks that ask for it are no strokes.
      digitizer_.drop();
      try_registration(time);
      return;
    case Action::kShowRegistration:
      verify_visible_at_.reset();
      level().check_points.clear();
      measure_residuals();
      unstroked_ = nav::unstroked_surface(
          *level().plan.model, level().registration->world_from_vertebra, level().newest->points);
      propose_checks();
      end_touch();
      return;
    case Action::kAccept:
      level().accepted = true;
      return;
    case Action::kClearLevel:
      level().registration.reset();
      level().predicted.clear();
      level().check_points.clear();
      level().accepted = false;
      if (coach_) {
        coach_->forget();
      }
      level().first_press.reset();
      // Wires driven on a registration that is thrown away are not undone; what was done stays.
      digitizer_.clear();
      last_guidance_.reset();
      return;
    case Action::kSelectScrew: {
      digitizer_.clear();
      const auto& done = level().screw_done;
      const auto open = std::find(done.begin(), done.end(), false);
      screw_ = open == done.end() ? 0 : static_cast<std::size_t>(open - done.begin());
      last_guidance_.reset();
      return;
    }
    case Action::kToggleTwin:
      twin_ = !twin_;
      return;
    case Action::kFinishScrew:
      finish_screw(time);
      return;
    default:
      return;
  }
}

void Session::begin_level() {
  const auto open = std::find_if(levels_.begin(), levels_.end(),
                                 [](const LevelState& level) { return !level.finished(); });
  level_ = open == levels_.end() ? 0 : static_cast<std::size_t>(open - levels_.begin());
  screw_ = 0;
  digitizer_.clear();
  if (coach_) {
    coach_->forget();
  }
  last_guidance_.reset();
}

void Session::drop_region(Timestamp time) {
  std::optional<nav::Region> gone = digitizer_.drop();
  const bool asked = std::exchange(asked_to_drop_saved_, std::nullopt) >= time - kSaidTwiceWithin;
  if (!gone && asked) {
    gone = digitizer_.drop_saved();
  }
  if (gone) {
    // It fades instead of vanishing.
    dropped_ = {std::move(*gone), time};
    return;
  }
  // One word too many must not cost a good region.
  const auto regions = digitizer_.regions();
  const auto last =
      std::find_if(regions.rbegin(), regions.rend(), [](const nav::Region& r) { return r.saved; });
  if (last == regions.rend()) {
    say("nothing to delete", time);
    return;
  }
  asked_to_drop_saved_ = time;
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "say delete again to drop the last saved %zu points",
                last->samples.size());
  say(text.data(), time);
}

void Session::try_registration(Timestamp time) {
  LevelState& now = level();
  ++now.attempts;
  now.warning = tag_size_warning();
  // The trial under way has lost its use, and this one shall have the machine to itself.
  if (coach_) {
    coach_->forget();
  }
  const std::vector<Point<World>> points = digitizer_.saved_points();
  const std::vector<double> sds_m = digitizer_.saved_point_sds_m();
  const std::vector<Vec3> shafts = digitizer_.saved_shafts();
  const auto result = method_.registrar(
      {*now.plan.model, points, now.plan.screws, now.plan.neighbours, sds_m, shafts});
  now.newest.reset();
  if (result) {
    now.newest = RegistrationAttempt{points, *result};
  }
  std::string reason;
  if (!result) {
    reason = result.error().message;
  } else if (!result->accepted) {
    reason = joined(result->reasons);
    if (reason.empty()) {
      reason = "registration not accepted";
    }
  }
  if (reason.empty()) {
    now.registration = *result;
    now.predicted = nav::predicted_errors(*result, now.plan.screws);
    now.digitization_s = now.first_press ? seconds(time - *now.first_press) : 0.0;
  } else {
    refuse_registration(reason, result ? &*result : nullptr, time);
  }
  if (observer_) {
    observer_->registered(time, now, result ? &*result : nullptr, reason);
  }
  handle(reason.empty() ? Event::kRegistered : Event::kRegistrationRefused, time);
}

/// With what to do about it, if that is known.
void Session::refuse_registration(const std::string& reason, const nav::Registration* result,
                                  Timestamp time) {
  std::string advice;
  if (result) {
    advice = result->fits_better.empty() ? result->advice : "make sure of the level";
  }
  say("refused: " + reason + (advice.empty() ? "" : "; " + advice), time);
  if (result && coach_) {
    coach_->tell(coaching_from(*result), digitizer_.saved_count());
  }
}

void Session::finish_screw(Timestamp time) {
  LevelState& now = level();
  now.screw_done[screw_] = true;
  if (observer_) {
    observer_->screw_done(time, now, now.plan.screws[screw_],
                          last_guidance_ ? &*last_guidance_ : nullptr);
  }
  const auto finished = [](const LevelState& state) { return state.finished(); };
  if (!finished(now)) {
    handle(Event::kAnotherScrew, time);
  } else if (!std::all_of(levels_.begin(), levels_.end(), finished)) {
    handle(Event::kAnotherLevel, time);
  } else {
    handle(Event::kNoScrewLeft, time);
  }
}

}  // namespace orthonav::engine
