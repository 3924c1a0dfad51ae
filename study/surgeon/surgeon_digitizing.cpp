#include <algorithm>
#include <cmath>
#include <utility>

#include "study/surgeon/scripted_surgeon.h"

namespace orthonav::sim {
namespace {

// Liebmann et al. 2019 report 125 ± 27 s for the digitization of a level and 1,983 ± 404 points at
// 30 Hz, that is 66.1 s with the button pressed. One region in nine is a repeat at the default
// probability of slipping; what remains is divided between stroking and everything else.
constexpr double kStroking_s = 66.1;
constexpr double kBetweenStrokes_s = 46.4;
// How the time around one region is spent.
constexpr double kApproaching = 0.40;
constexpr double kSettling = 0.10;
constexpr double kLookingBack = 0.15;
constexpr double kAfterWord = 0.35;
constexpr double kHop_s = 0.8;          // from one stroke of a region to the next
constexpr double kLeastAround_s = 1.5;  // there is always time for a command
constexpr double kLift_m = 0.015;
/// The wavelengths of the tip's height at the default of `stroke_lift_length_m`, which stretches
/// them.
constexpr double kLongestLift_m = 0.030;
constexpr double kShortestLift_m = 0.007;
constexpr double kVerdict_s = 1.5;
/// After a refusal the surgeon presses harder. Estimate.
constexpr double kHarder = 0.7;

/// Where and how far the tip leaves the bone in a stroke that slips.
struct Slip {
  double at_m = 0.0;
  double width_m = 0.0;
  double height_m = 0.0;

  [[nodiscard]] double lift_m(double along_m) const {
    const double z = (along_m - at_m) / width_m;
    return height_m * std::exp(-0.5 * z * z);
  }
};

BoneSpot in_room(const Transform<Room, Vertebra>& room_from_vertebra, const BoneSpot& spot) {
  return {(room_from_vertebra * Point<Vertebra>{spot.point}).v,
          (room_from_vertebra * Direction<Vertebra>{spot.normal}).v};
}

}  // namespace

ScriptedSurgeon::Tempo ScriptedSurgeon::tempo(std::size_t level) const {
  double total_m = 0.0;
  double hops = 0.0;
  for (const StrokeRegion& region : regions_[level]) {
    total_m += region.length_m();
    hops += static_cast<double>(region.strokes.size() - 1);
  }
  const double between_regions_s =
      (kBetweenStrokes_s - hops * kHop_s) / static_cast<double>(regions_[level].size());
  return {kStroking_s / total_m, std::max(kLeastAround_s, between_regions_s)};
}

Script ScriptedSurgeon::digitize(std::size_t level) {
  const StepOnDisplay step = step_now();
  const bool adds_strokes = std::exchange(refused_, false);
  co_await body_.take(ToolKind::kPointer, layout_->site(level));
  for (const StrokeRegion& region : regions_[level]) {
    bool slips = true;
    while (slips) {
      if (!in_step(step)) {
        co_return;
      }
      slips = body_.random().uniform() < error_model_->bad_stroke_probability;
      co_await record(level, region, slips);
    }
    // What was stroked before a refusal still counts: only until the display says that it is
    // enough.
    if (adds_strokes && eyes_.status() && eyes_.status()->strokes_enough) {
      break;
    }
  }
  co_await body_.double_click();
}

Script ScriptedSurgeon::record(std::size_t level, const StrokeRegion& region, bool slips) {
  const auto [stroking_s_per_m, around_s] = tempo(level);
  const double speed = std::max(0.5, body_.random().normal(1.0, error_model_->stroke_pace_sd));
  const auto slipping = static_cast<std::size_t>(body_.random().uniform() *
                                                 static_cast<double>(region.strokes.size()));
  for (std::size_t i = 0; i < region.strokes.size(); ++i) {
    const Stroke& stroke = region.strokes[i];
    const BoneSpot start = in_room(layout_->room_from_vertebra(level), stroke.spots.front());
    const double approach_s = i == 0 ? (kApproaching + kSettling) * around_s : kHop_s;
    body_.posture().contact_normal.reset();
    co_await body_.move({{start.point}, body_.pointer_axis(start.normal), 0.0}, 0.8 * approach_s,
                        i == 0 ? kLift_m : 0.5 * kLift_m);
    body_.posture().contact_normal = start.normal;
    co_await body_.rest(0.2 * approach_s);
    body_.press();
    co_await slide(level, stroke, speed * stroking_s_per_m * stroke.length_m(),
                   slips && i == slipping);
    body_.release();
  }
  co_await body_.rest(kLookingBack * around_s);
  body_.say(slips ? words().drop : words().save);
  co_await body_.rest(kAfterWord * around_s);
}

Script ScriptedSurgeon::slide(std::size_t level, const Stroke& stroke, double duration_s,
                              bool slips) {
  const auto& room_from_vertebra = layout_->room_from_vertebra(level);
  const double length_m = stroke.length_m();
  const SmoothNoise lift(body_.random().fork(body_.random().next()),
                         lightness_ * error_model_->stroke_lift_m, 1.0 / kLongestLift_m,
                         1.0 / kShortestLift_m);
  const double stretch = error_model_->stroke_lift_length_m > 0.0
                             ? error_model_->stroke_lift_length_m / kLongestLift_m
                             : 1.0;
  Slip slip{length_m * body_.random().uniform(0.3, 0.8), 0.06 * length_m + 1e-6,
            slips ? body_.random().uniform(0.5, 1.0) * error_model_->bad_stroke_lift_m : 0.0};
  const Timestamp begin = body_.now();
  const double length_s = body_.slowness() * duration_s;
  for (double t = 0.0; t < 1.0;) {
    co_await body_.next_tick();
    t = std::min(1.0, seconds(body_.now() - begin) / length_s);
    const double along_m = length_m * minimum_jerk(t);
    const BoneSpot spot = in_room(room_from_vertebra, stroke.at(along_m));
    // The bone stops the tip, so it can only be lifted off.
    const double lift_m =
        std::abs(lift.at(along_m / stretch)) + stroke.tissue_at(along_m) + slip.lift_m(along_m);
    body_.posture().grip.tip = {spot.point + lift_m * spot.normal};
    body_.posture().contact_normal = spot.normal;
  }
}

Script ScriptedSurgeon::await_verdict(std::size_t level, StepOnDisplay step) {
  // The line may still show why the last attempt was refused.
  co_await body_.rest(kVerdict_s / body_.slowness());
  for (int repeat = 0; repeat <= kRepeats; ++repeat) {
    const Timestamp end = body_.now() + from_seconds(kPatience_s);
    while (body_.now() < end) {
      const bool computed =
          eyes_.status() && step_now().step == Step::kRegistering;  // and not answered yet
      if (!in_step(step) && !computed) {
        co_return;
      }
      if (told(Notice::kRegistrationRefused)) {
        lightness_ *= kHarder;
        refused_ = true;
        if (++failures_[level] >= kMaxFailures) {
          give_up();
        }
        co_return;
      }
      co_await body_.next_tick();
    }
    if (repeat < kRepeats) {
      co_await body_.double_click();
    }
  }
  give_up();
}

}  // namespace orthonav::sim
