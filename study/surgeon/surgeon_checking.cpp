#include <algorithm>
#include <cmath>
#include <limits>

#include "study/surgeon/scripted_surgeon.h"

namespace orthonav::sim {
namespace {

constexpr double kReach_s = 1.5;
/// From one place on the bone to the next, without searching for the tip again: time to start and
/// set down, and the speed of a tapping hand in between.
constexpr double kDab_s = 0.4;
constexpr double kDabPace_m_per_s = 0.08;
constexpr double kDabLift_m = 0.008;
/// Fraction of soft tissue that remains under a pressed tip. Estimate.
constexpr double kPressedTissue = 0.08;
constexpr double kTouchLift_m = 0.02;
constexpr double kSettle_s = 1.0;
constexpr double kDabSettle_s = 0.6;
constexpr double kReadLine_s = 0.5;
/// Looking from another side before a touch is tried again.
constexpr double kAside_rad = 0.12;
constexpr double kLeanAndSettle_s = 2.0;
/// A glance at the line, near the tip, shows whether the touch was taken.
constexpr double kDabGlance_s = 0.15;
/// Upper bound on the width of a vertebra.
constexpr double kAcross_m = 0.10;
/// The first places are as far apart as possible; further ones, if the line asks for more, at least
/// this far.
constexpr double kApart_m = 0.005;
/// A touch that does not fit is deleted if at least this many others fit, at most twice; after that
/// the registration is rejected.
constexpr std::size_t kKnown = 8;
constexpr std::size_t kMaxTakenBack = 2;
constexpr double kTakeBack_s = 1.5;
/// So many places the surgeon chooses, so that the check does not depend on what is checked; from
/// then on they touch where the display shows a place.
constexpr std::size_t kOwnChoice = 3;
constexpr double kSpotsApart_m = 0.001;
/// The largest number of places that count, if the line keeps asking.
constexpr std::size_t kMaxPlaces = 48;
/// The very ends of strokes are not touched, since the tip would slip off.
constexpr double kFromEnd = 0.2;

}  // namespace

std::vector<BoneSpot> ScriptedSurgeon::places_to_check(std::size_t level) {
  std::vector<BoneSpot> spots;
  for (const StrokeRegion& region : regions_[level]) {
    for (const Stroke& stroke : region.strokes) {
      for (double way = kFromEnd; way <= 1.0 - kFromEnd; way += 0.1) {
        spots.push_back(stroke.on_tissue(way * stroke.length_m(), kPressedTissue));
      }
    }
  }
  std::vector<BoneSpot> places;
  if (spots.empty()) {
    return places;
  }
  const double any = checking_.uniform() * static_cast<double>(spots.size());
  places.push_back(spots[static_cast<std::size_t>(any)]);
  const auto nearest_m = [&places](const BoneSpot& spot) {
    double least = std::numeric_limits<double>::infinity();
    for (const BoneSpot& place : places) {
      least = std::min(least, (place.point - spot.point).norm());
    }
    return least;
  };
  while (places.size() < kMaxPlaces) {
    const auto farthest = std::max_element(
        spots.begin(), spots.end(),
        [&](const BoneSpot& a, const BoneSpot& b) { return nearest_m(a) < nearest_m(b); });
    if (nearest_m(*farthest) < kApart_m) {
      break;
    }
    places.push_back(*farthest);
  }
  return places;
}

std::optional<BoneSpot> ScriptedSurgeon::place_shown(std::size_t level) {
  const auto shown = eyes_.find_place_to_touch();
  if (!shown) {
    return std::nullopt;
  }
  const Point<Room> seen = seen_at_rest(*shown);
  const Vec3 off = misperceived(checking_, seen, error_model_->overlay_perception_m);
  const Vec3 wanted = (layout_->room_from_vertebra(level).inverse() * Point<Room>{seen.v + off}).v;
  std::optional<BoneSpot> nearest;
  for (const StrokeRegion& region : regions_[level]) {
    for (const Stroke& stroke : region.strokes) {
      for (double along_m = 0.0; along_m <= stroke.length_m(); along_m += kSpotsApart_m) {
        const BoneSpot spot = stroke.on_tissue(along_m, kPressedTissue);
        if (!nearest || (spot.point - wanted).norm() < (nearest->point - wanted).norm()) {
          nearest = spot;
        }
      }
    }
  }
  return nearest;
}

Script ScriptedSurgeon::touch_place(const StepOnDisplay& step, const BoneSpot& place) {
  // The bone stops the tip, so soft tissue can only hold it off.
  const double lift_m = std::abs(checking_.normal(0.0, error_model_->touch_lift_m));
  const Point<Room> tip{place.point + lift_m * place.normal};
  const double way_m = (body_.posture().grip.tip - tip).norm();
  const bool near = body_.posture().in_hand == ToolKind::kPointer && way_m < kAcross_m;
  if (!near) {
    co_await touch_at(step, tip, place.normal);
    co_return;
  }
  co_await body_.move({tip, body_.pointer_axis(place.normal), 0.0},
                      kDab_s + way_m / kDabPace_m_per_s, kDabLift_m);
  co_await click_at_rest(step, place.normal, kDabSettle_s, kDabGlance_s);
}

Script ScriptedSurgeon::touch_at(const StepOnDisplay& step, Point<Room> tip, Vec3 normal) {
  body_.look(tip);
  co_await hold_at(step, tip, normal, body_.pointer_axis(normal));
}

Script ScriptedSurgeon::hold_at(const StepOnDisplay& step, Point<Room> tip, Vec3 normal,
                                Vec3 axis) {
  body_.posture().contact_normal.reset();
  co_await body_.move({tip, axis, 0.0}, kReach_s, kTouchLift_m);
  co_await click_at_rest(step, normal, kSettle_s, kReadLine_s);
}

Script ScriptedSurgeon::click_at_rest(const StepOnDisplay& step, Vec3 normal, double settle_s,
                                      double read_s) {
  body_.posture().contact_normal = normal;
  co_await click_until_taken(step, settle_s, read_s / body_.slowness());
  body_.posture().contact_normal.reset();
}

Script ScriptedSurgeon::click_until_taken(const StepOnDisplay& step, double settle_s,
                                          double read_s) {
  const Vec3 from = body_.posture().head.from_gaze;
  for (int repeat = 0; repeat <= kRepeats && in_step(step); ++repeat) {
    const bool aside = repeat > 0 && relies_on_reference_;
    if (aside) {
      // A tag may be hidden from here, by another one or by the hand.
      const double aside_rad = kAside_rad * (repeat % 2 == 0 ? -repeat : repeat + 1);
      body_.posture().head.from_gaze = rotation_from_vector({0, aside_rad, 0}) * from;
    }
    co_await body_.rest(aside ? kLeanAndSettle_s : (repeat == 0 ? settle_s : kSettle_s));
    co_await body_.click();
    co_await body_.rest(read_s);
    if (!told(Notice::kTouchNotRecorded)) {
      break;
    }
  }
}

Script ScriptedSurgeon::check_by_touch(std::size_t level, bool& fits) {
  const StepOnDisplay step = step_now();
  const std::vector<BoneSpot> places = places_to_check(level);
  std::size_t taken_back = 0;
  // If the line asks for more places than there are, a place is pressed a second time.
  for (std::size_t touch = 0; !places.empty() && touch < 2 * kMaxPlaces; ++touch) {
    if (in_step(step) && asked(ChecksAsked::kReject) && touch >= kKnown &&
        taken_back < kMaxTakenBack) {
      // The others agree: the touch slipped, or the model deviates from the bone there.
      ++taken_back;
      body_.say(words().drop);
      co_await body_.rest(kTakeBack_s);
    }
    if (!in_step(step) || !asked(ChecksAsked::kTouchMore)) {
      break;
    }
    const auto shown = touch < kOwnChoice ? std::nullopt : place_shown(level);
    const BoneSpot place = shown.value_or(places[touch % places.size()]);
    const auto& room_from_vertebra = layout_->room_from_vertebra(level);
    co_await touch_place(step, {(room_from_vertebra * Point<Vertebra>{place.point}).v,
                                (room_from_vertebra * Direction<Vertebra>{place.normal}).v});
    // A message disappears after a while; the line then asks again, or does not.
    const Timestamp end = body_.now() + from_seconds(kPatience_s);
    while (in_step(step) && told(Notice::kTouchNotRecorded) && body_.now() < end) {
      co_await body_.next_tick();
    }
  }
  if (asked(ChecksAsked::kReject)) {
    fits = false;
  }
}

}  // namespace orthonav::sim
