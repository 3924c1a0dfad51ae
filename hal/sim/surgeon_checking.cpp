#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/sim/surgeon.h"

namespace orthonav::sim {
namespace {

constexpr double kReach_s = 1.5;
/// What is left of soft tissue under a tip that is pressed through it. Estimate.
constexpr double kPressedTissue = 0.08;
constexpr double kTouchLift_m = 0.02;
constexpr double kSettle_s = 1.0;
constexpr double kReadLine_s = 0.5;
/// The first ones are as far apart as they can be; those that follow where the line asks for more,
/// at least so far.
constexpr double kApart_m = 0.005;
/// As many as count, where the line goes on asking.
constexpr std::size_t kMostPlaces = 20;
/// Nobody touches the very ends of what is stroked: there the tip slips off.
constexpr double kFromEnd = 0.2;

}  // namespace

std::vector<BoneSpot> Surgeon::places_to_check(std::size_t level) {
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
  while (places.size() < kMostPlaces) {
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

Script Surgeon::touch_place(const StepOnDisplay& step, const BoneSpot& place) {
  // The bone stops the tip, so soft tissue can only hold it off.
  const double lift_m = std::abs(checking_.normal(0.0, error_model_->touch_lift_m));
  co_await touch_at(step, {place.point + lift_m * place.normal}, place.normal);
}

Script Surgeon::touch_at(const StepOnDisplay& step, Point<Room> tip, Vec3 normal) {
  body_.look(tip);
  body_.posture().contact_normal.reset();
  co_await body_.move({tip, body_.pointer_axis(normal), 0.0}, kReach_s, kTouchLift_m);
  body_.posture().contact_normal = normal;
  // The line says when a touch was not taken: rest a little longer and click again.
  for (int repeat = 0; repeat <= kRepeats && in_step(step); ++repeat) {
    co_await body_.rest(kSettle_s);
    co_await body_.click();
    co_await body_.rest(kReadLine_s / body_.slowness());
    if (!told(Notice::kTouchNotRecorded)) {
      break;
    }
  }
  body_.posture().contact_normal.reset();
}

Script Surgeon::check_by_touch(std::size_t level, bool& fits) {
  const StepOnDisplay step = step_now();
  const std::vector<BoneSpot> places = places_to_check(level);
  // Where the line asks for more than there are, a place is pressed a second time.
  for (std::size_t touch = 0; !places.empty() && touch < 2 * kMostPlaces; ++touch) {
    if (!in_step(step) || !asked(ChecksAsked::kTouchMore)) {
      break;
    }
    const BoneSpot& place = places[touch % places.size()];
    const auto& room_from_vertebra = layout_->room_from_vertebra(level);
    co_await touch_place(step, {(room_from_vertebra * Point<Vertebra>{place.point}).v,
                                (room_from_vertebra * Direction<Vertebra>{place.normal}).v});
    // A message goes after a while, and the line asks again or is content.
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
