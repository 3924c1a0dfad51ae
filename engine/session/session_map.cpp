#include "engine/session/session.h"

namespace orthonav::engine {

/// World is another one: whatever was measured in it is gone. What the patient has already, and
/// what was measured of it, stays in the report.
void Session::forget_map(Timestamp time) {
  for (LevelState& level : levels_) {
    level.map_moved = level.registration.has_value() && level.finished();
    if (level.map_moved) {
      continue;
    }
    level.registration.reset();
    level.predicted.clear();
    level.check_points.clear();
    level.first_press.reset();
    level.accepted = false;
  }
  for (RodState& rod : rods_) {
    rod.map_moved = rod.done;
    if (rod.done) {
      continue;
    }
    rod.heads.clear();
    rod.rod.reset();
  }
  digitizer_.clear();
  dropped_ = {};
  asked_to_drop_saved_.reset();
  end_touch();
  residuals_m_.clear();
  unstroked_.clear();
  places_to_check_.clear();
  to_check_.clear();
  verify_visible_at_.reset();
  last_guidance_.reset();
  guidance_.head.reset();
  if (coach_) {
    coach_->forget();
  }
  for (ToolWatch& watch : watches_) {
    watch = {};
  }
  if (step_ == Step::kDigitize) {
    say("the headset's map moved: digitize again", time);
  }
  if (step_ == Step::kRod) {
    say("the headset's map moved: touch this rod's heads again", time);
  }
  if (step_ == Step::kDone) {
    say("the headset's map moved", time);
  }
}

}  // namespace orthonav::engine
