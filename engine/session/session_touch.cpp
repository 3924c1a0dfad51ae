#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/length_text.h"
#include "engine/session/session.h"

namespace orthonav::engine {

void Session::act_on_touch(Action action, Timestamp time) {
  switch (action) {
    case Action::kBeginTouch:
      touch_.clear();
      touching_ = true;
      touch_begun_ = true;
      return;
    case Action::kDropTouch:
      end_touch();
      say(std::string(step_ == Step::kRod ? "head" : "check point") +
              " not recorded: hold too long",
          time);
      return;
    default:
      return;
  }
}

void Session::act_on_checks(Action action, Timestamp time) {
  switch (action) {
    case Action::kRecordCheck:
      record_check(time);
      return;
    case Action::kDropCheck:
      drop_check(time);
      return;
    case Action::kJudgeChecks:
      judge_checks(time);
      return;
    case Action::kAskForChecks:
      say("not accepted: " + nav::verdict_on(level().check_points, options_.check_points).advice,
          time);
      return;
    default:
      return;
  }
}

void Session::act_on_rod(Action action, Timestamp time) {
  switch (action) {
    case Action::kBeginRod:
      end_touch();
      return;
    case Action::kRecordHead:
      record_head(time);
      return;
    case Action::kDropHead:
      drop_head(time);
      return;
    case Action::kFinishRod:
      finish_rod(time);
      return;
    case Action::kMoveRod:
      rods_moved_away_ = !rods_moved_away_;
      return;
    default:
      return;
  }
}

void Session::end_touch() {
  touch_.clear();
  touching_ = false;
  touch_begun_ = false;
}

Result<Point<World>> Session::touched_place(Timestamp time) const {
  // The press fell into another step, or another rod.
  if (!touch_begun_) {
    return Error{"press again"};
  }
  if (touch_.empty()) {
    // A click shorter than a frame: the pose of the pair just before it.
    const ToolWatch& pointer = watches_[pointer_];
    if (!pointer.fresh(time, options_.stale_after)) {
      return Error{"pointer not seen"};
    }
    return pointer.last_measured_pose().value * tracker_->tools()[pointer_].tip_in_marker;
  }
  const auto count = static_cast<double>(touch_.size());
  Vec3 sum{};
  for (const Point<World>& tip : touch_) {
    sum += tip.v;
  }
  const Vec3 mean = sum / count;
  double squares = 0.0;
  for (const Point<World>& tip : touch_) {
    squares += (tip.v - mean).dot(tip.v - mean);
  }
  const double spread_m = std::sqrt(squares / count);
  if (spread_m <= options_.max_touch_spread_m) {
    return Point<World>{mean};
  }
  return Error{"tip moved " + in_mm(spread_m) + ", limit " + in_mm(options_.max_touch_spread_m)};
}

void Session::measure_residuals() {
  const LevelState& now = level();
  const auto vertebra_from_world = now.registration->world_from_vertebra.inverse();
  residuals_m_.clear();
  std::vector<float> each_m;
  for (const Point<World>& point : now.newest->points) {
    const auto nearest =
        now.plan.model->reachable_surface().nearest((vertebra_from_world * point).v);
    each_m.push_back(nearest ? static_cast<float>(nearest->distance_m)
                             : std::numeric_limits<float>::infinity());
  }
  // One sample says little: the mean over a stretch of the stroke, or it is a speckle.
  constexpr std::size_t kStretch = 10;
  for (std::size_t i = 0; i < each_m.size(); ++i) {
    const std::size_t first = i - std::min(i, kStretch);
    const std::size_t last = std::min(i + kStretch + 1, each_m.size());
    float sum = 0.0f;
    for (std::size_t k = first; k < last; ++k) {
      sum += each_m[k];
    }
    residuals_m_.push_back(sum / static_cast<float>(last - first));
  }
}

void Session::propose_checks() {
  const LevelState& now = level();
  places_to_check_.clear();
  if (method_.verification == Verification::kByTouch) {
    places_to_check_ = nav::places_to_check(*now.plan.model, now.registration->world_from_vertebra,
                                            now.newest->points, options_.check_points);
  }
  to_check_ = places_to_check_;
}

void Session::record_check(Timestamp time) {
  LevelState& now = level();
  const auto place = touched_place(time);
  end_touch();
  if (!place || now.check_points.size() >= nav::kMostCheckPoints) {
    say("check point not recorded: " +
            (place ? "there are " + std::to_string(nav::kMostCheckPoints) + " already"
                   : place.error().message),
        time);
    return;
  }
  now.check_points.push_back(nav::check_point(
      *now.plan.model, now.registration->world_from_vertebra, *place, options_.check_points));
  to_check_ = nav::still_to_check(places_to_check_, now.check_points);
  if (observer_) {
    observer_->check_point_recorded(time, now);
  }
}

void Session::drop_check(Timestamp time) {
  LevelState& now = level();
  if (now.check_points.empty()) {
    say("no check point to delete", time);
    return;
  }
  now.check_points.pop_back();
  to_check_ = nav::still_to_check(places_to_check_, now.check_points);
  if (observer_) {
    observer_->check_point_dropped(time, now);
  }
}

void Session::judge_checks(Timestamp time) {
  const bool passed = nav::verdict_on(level().check_points, options_.check_points).passed;
  handle(passed ? Event::kChecked : Event::kNotChecked, time);
}

void Session::record_head(Timestamp time) {
  const auto head = touched_place(time);
  end_touch();
  if (!head) {
    say("head not recorded: " + head.error().message, time);
    return;
  }
  rods_[rod_].heads.push_back(*head);
  update_rod(time);
  if (observer_) {
    observer_->head_recorded(time, rods_[rod_].side, *head);
  }
}

void Session::drop_head(Timestamp time) {
  RodState& rod = rods_[rod_];
  if (rod.heads.empty()) {
    say("no head to delete", time);
    return;
  }
  rod.heads.pop_back();
  update_rod(time);
  if (observer_) {
    observer_->head_dropped(time, rod.side);
  }
}

void Session::update_rod(Timestamp time) {
  RodState& rod = rods_[rod_];
  rod.rod.reset();
  if (rod.heads.size() < 2) {
    return;
  }
  std::vector<Vec3> heads;
  for (const Point<World>& head : rod.heads) {
    heads.push_back(head.v);
  }
  auto made = nav::rod_template(heads, options_.rod_diameter_m);
  if (made) {
    rod.rod = std::move(*made);
  } else {
    say("no rod: " + made.error().message, time);
  }
}

void Session::finish_rod(Timestamp time) {
  if (observer_) {
    observer_->rod_done(time, rods_[rod_]);
  }
  rods_[rod_].done = true;
  const bool another = rod_ + 1 < rods_.size();
  if (another) {
    ++rod_;
  }
  handle(another ? Event::kAnotherSide : Event::kNoSideLeft, time);
}

}  // namespace orthonav::engine
