#include <utility>

#include "engine/session/session.h"

namespace orthonav::engine {

// What is done in the step `accepted`: the landmark is touched, and the tips are compared in it.

void Session::touch_landmark(Timestamp time) {
  const TouchedPlace place = touched_place(time);
  if (const auto guide_tip = guide_tip_in_landmark(place)) {
    return compare_tips(*guide_tip, time);
  }
  const auto taken = landmarking_.take(level(), place, tools_.reference_posts(), anchored(), time);
  if (const auto* refusal = std::get_if<TouchRefusal>(&taken)) {
    messages_.say(TouchNotRecorded{TouchNotRecorded::What::kLandmark, *refusal}, time);
    return;
  }
  const auto& touch = std::get<LandmarkTouch>(taken);
  note_bone_found(touch, time);
  if (observer_ && touch.missing == 0) {
    observer_->landmark_touched(time, level(), touch);
  }
  if (touch.moved()) {
    handle(Event::kLandmarkMoved, time);
  }
}

void Session::note_bone_found(const LandmarkTouch& touch, Timestamp time) {
  if (touch.missing > 0 || touch.moved()) {
    return;
  }
  LevelState& now = level();
  // Of a registration that was restored nobody knows when the bone was found last.
  const BoneFound before =
      now.bone_found.value_or(BoneFound{time, 0.0, options_.map_drift_m_per_sqrt_s});
  now.bone_found = found_by_landmark(before, touch, *now.landmark, time);
  now.unverified = false;
  if (touch.first) {
    now.landmark->bone_sd_m = now.bone_found->sd_m;
  }
}

/// Where the pointer's tip was in it; it was touched.
nav::PressedPlace Session::touched_landmark() const {
  return {level().registration->world_from_vertebra * landmarking_.mean_place(),
          landmarking_.sd_m()};
}

/// Once the pointer was in the dimple the guide may follow: a press is that of the tool whose tip
/// is nearer to it.
std::optional<nav::PressedPlace> Session::guide_tip_in_landmark(const TouchedPlace& pointer) {
  constexpr double kInReach_m = 0.02;
  if (!options_.steps.tips) {
    return std::nullopt;
  }
  const TouchedPlace guide =
      tip_check_.touch().take_place(std::nullopt, options_.max_touch_spread_m);
  const auto* guide_tip = std::get_if<nav::PressedPlace>(&guide);
  if (!guide_tip || !landmarking_.touched()) {
    return std::nullopt;
  }
  const Point<World> dimple = touched_landmark().place;
  const double guide_m = (guide_tip->place - dimple).norm();
  const auto* pointer_tip = std::get_if<nav::PressedPlace>(&pointer);
  const bool nearer = !pointer_tip || guide_m < (pointer_tip->place - dimple).norm();
  return nearer && guide_m <= kInReach_m ? std::optional(*guide_tip) : std::nullopt;
}

void Session::compare_tips(const nav::PressedPlace& guide_tip, Timestamp time) {
  const auto taken =
      tip_check_.take(guide_tip, tools_.watch(tools_.guide()).last_measured_pose().value,
                      touched_landmark(), anchored(), tools_.tag_size_difference_sd());
  if (const auto* refusal = std::get_if<TouchRefusal>(&taken)) {
    messages_.say(TouchNotRecorded{TouchNotRecorded::What::kGuideTip, *refusal}, time);
  } else if (observer_) {
    observer_->tips_compared(time, std::get<TipDifference>(taken));
  }
}

/// The tip first, then the axis: one word for each, once the landmark was touched and the status
/// line offers it.
void Session::correct_guide(Timestamp time) {
  if (consents_to_breach(time)) {
    return;
  }
  if (landmarking_.touched() && tip_check_.offers()) {
    return correct_tip(time);
  }
  if (landmarking_.touched() && axis_check_.offers()) {
    return correct_axis(time);
  }
  messages_.say(NotPossibleNow{Event::kSayAccept}, time);
}

void Session::correct_tip(Timestamp time) {
  guiding_.forget_guidance();
  const Vec3 by_m = tip_check_.correct();
  tools_.correct_guide_tip(tools_.geometry(tools_.guide()).tip_in_marker - by_m);
  messages_.say(TipCorrected{by_m.norm()}, time);
  if (observer_) {
    observer_->tips_compared(time, *tip_check_.last());
  }
}

void Session::correct_axis(Timestamp time) {
  guiding_.forget_guidance();
  tools_.correct_guide_axis(axis_check_.correct());
  messages_.say(AxisCorrected{axis_check_.last()->by_rad}, time);
  if (observer_) {
    observer_->axis_compared(time, *axis_check_.last());
  }
}

void Session::drop_landmark(Timestamp time) {
  const Landmarking::Dropped dropped = landmarking_.drop(level());
  if (dropped == Landmarking::Dropped::kNothing) {
    messages_.say(NothingToDelete{NothingToDelete::What::kLandmark}, time);
  } else if (observer_ && dropped == Landmarking::Dropped::kPlace) {
    observer_->landmark_dropped(time, level());
  }
}

void Session::judge_landmark(Timestamp time) {
  handle(landmarking_.touched() ? Event::kLandmarkTouched : Event::kLandmarkMissing, time);
}

/// The landmark stays: what is accepted next must put the bone where it was touched first.
void Session::verify_again(Timestamp time) {
  const LandmarkTouch& touch = *landmarking_.last();
  level().accepted = false;
  verifying_.begin_again(level(), touch.off_m);
  guiding_.forget_guidance();
  if (observer_) {
    observer_->acceptance_withdrawn(time, level());
  }
  messages_.say(LandmarkMoved{touch.off_m, touch.limit_m, anchored()}, time);
}

}  // namespace orthonav::engine
