#include <vector>

#include "hal/sim/room/noise.h"
#include "study/surgeon/scripted_surgeon.h"

namespace orthonav::sim {
namespace {

constexpr int kMaxTouches = 40;
constexpr double kLookAnew_s = 2.0;
/// Along a pedicle screw outward, unit: 20° of convergence, as any surgeon knows it.
constexpr Vec3 kLeftScrew{0.342, 0.940, 0.0};
constexpr Vec3 kRightScrew{-0.342, 0.940, 0.0};

}  // namespace

Script ScriptedSurgeon::touch_landmark(std::size_t level) {
  const StepOnDisplay step = step_now();
  co_await body_.take(ToolKind::kPointer, layout_->site(level));
  const bool made = landmarks_[level].has_value();
  const std::vector<BoneSpot> places =
      made ? std::vector<BoneSpot>{*landmarks_[level]} : places_to_check(level);
  std::size_t place = 0;
  for (int touch = 0; touch < kMaxTouches && in_step(step) && !finished_; ++touch) {
    landmarks_[level] = places[place];
    const Seat seat = seat_in_landmark(level);
    co_await touch_at(step, seat.tip, seat.normal);
    // A refused place, for example too near to the reference, is replaced by another one.
    place = told(Notice::kTouchNotRecorded) ? (place + 1) % places.size() : place;
    const Timestamp end = body_.now() + from_seconds(kPatience_s);
    while (in_step(step) && told(Notice::kTouchNotRecorded) && body_.now() < end) {
      co_await body_.next_tick();
    }
    if (!asked(ChecksAsked::kTouchMore)) {
      break;
    }
  }
}

ScriptedSurgeon::Seat ScriptedSurgeon::seat_in_landmark(std::size_t level) {
  const auto& room_from_vertebra = layout_->room_from_vertebra(level);
  const BoneSpot& spot = *landmarks_[level];
  const Vec3 off = normal_vector(seating_, error_model_->landmark_seating_m);
  return {room_from_vertebra * Point<Vertebra>{spot.point} + off,
          (room_from_vertebra * Direction<Vertebra>{spot.normal}).v};
}

Script ScriptedSurgeon::compare_tips(std::size_t level) {
  const StepOnDisplay step = step_now();
  co_await body_.take(ToolKind::kGuide, layout_->site(level));
  const Seat seat = seat_in_landmark(level);
  co_await touch_at(step, seat.tip, seat.normal);
}

Script ScriptedSurgeon::compare_tips_as_for_screw(std::size_t level) {
  const StepOnDisplay step = step_now();
  co_await body_.take(ToolKind::kGuide, layout_->site(level));
  const Seat seat = seat_in_landmark(level);
  // The left screw comes first.
  const bool left = !driven_.contains({Step::kGuide, step.level, Side::kLeft});
  const Vec3 axis =
      (layout_->room_from_vertebra(level) * Direction<Vertebra>{left ? kLeftScrew : kRightScrew}).v;
  body_.look(seat.tip, best_view(axis));
  co_await body_.rest(kLookAnew_s);
  co_await hold_at(step, seat.tip, seat.normal, axis);
}

Script ScriptedSurgeon::consent_to_corrections(const StepOnDisplay& step) {
  constexpr int kMaxTimes = 4;
  for (int time = 0; time < kMaxTimes && in_step(step); ++time) {
    if (!asked(ChecksAsked::kCorrectGuide)) {
      break;
    }
    body_.say(words().accept);
    co_await body_.rest(1.0);
    // The line reports the correction for a while; then it offers the next one, or none.
    const Timestamp end = body_.now() + from_seconds(kPatience_s);
    while (in_step(step) && (told(Notice::kTipCorrected) || told(Notice::kAxisCorrected)) &&
           body_.now() < end) {
      co_await body_.next_tick();
    }
  }
}

}  // namespace orthonav::sim
