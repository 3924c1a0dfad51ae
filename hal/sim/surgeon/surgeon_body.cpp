#include "hal/sim/surgeon/surgeon_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angle.h"

namespace orthonav::sim {
namespace {

constexpr Vec3 kUp{0, 1, 0};
constexpr double kHover_m = 0.06;
/// Eyes rest a little above the bone, between the site and the tool's tag.
constexpr double kGazeOverSite_m = 0.05;
constexpr double kReachForTool_s = 1.2;
/// A click lasts 80 ms and two of them follow within 200 ms, well within the time of a double
/// click.
constexpr double kClickDown_s = 0.08;
constexpr double kBetweenClicks_s = 0.10;

}  // namespace

SurgeonBody::SurgeonBody(Random random, const ErrorModel& error_model, double slowness,
                         const Posture& start)
    : random_(random), error_model_(&error_model), slowness_(slowness), posture_(start) {}

void SurgeonBody::tick(Timestamp now) {
  now_ = now;
  button_.advance(now, clicks);
  metronome_.tick();
}

Script SurgeonBody::rest(double duration_s) {
  const Timestamp end = now_ + from_seconds(slowness_ * duration_s);
  do {
    co_await next_tick();
  } while (now_ < end);
}

Script SurgeonBody::move(Grip goal, double duration_s, double lift_m) {
  const Grip start = posture_.grip;
  const Timestamp begin = now_;
  const double length_s = std::max(slowness_ * duration_s, 1e-3);
  for (double t = 0.0; t < 1.0;) {
    co_await next_tick();
    t = std::min(1.0, seconds(now_ - begin) / length_s);
    const double way = minimum_jerk(t);
    const double lift = lift_m * std::sin(std::numbers::pi * way);
    posture_.grip.tip = start.tip + way * (goal.tip - start.tip) + lift * kUp;
    posture_.grip.axis = rotated_towards(start.axis, goal.axis, way);
    posture_.grip.roll_rad = start.roll_rad + way * (goal.roll_rad - start.roll_rad);
  }
  posture_.grip = goal;
}

Grip SurgeonBody::parked(Point<Room> site) const {
  return {site + Vec3{-0.10, 0.10, 0.30}, kUp, 0.0};
}

Script SurgeonBody::take(ToolKind tool, Point<Room> site) {
  posture_.contact_normal.reset();
  look(site);
  const Grip over_site{site + kHover_m * kUp, pointer_axis(kUp), 0.0};
  if (posture_.in_hand != tool) {
    if (posture_.in_hand) {
      co_await move(parked(site), kReachForTool_s, 0.05);
    }
    posture_.in_hand.reset();
    posture_.grip = parked(site);
    co_await rest(0.5);
    posture_.in_hand = tool;
  }
  co_await move(over_site, kReachForTool_s, 0.03);
}

void SurgeonBody::look(Point<Room> site, std::optional<Vec3> from) {
  posture_.head.gaze = site + kGazeOverSite_m * kUp;
  posture_.head.from_gaze = from.value_or(HeadGoal{}.from_gaze);
}

void SurgeonBody::press() { button_.button(true, now_, clicks); }

void SurgeonBody::release() { button_.button(false, now_, clicks); }

Script SurgeonBody::click() {
  press();
  // A slow surgeon's thumb is as fast as any.
  co_await rest(kClickDown_s / slowness_);
  release();
}

Script SurgeonBody::double_click() {
  co_await click();
  co_await rest(kBetweenClicks_s / slowness_);
  co_await click();
}

void SurgeonBody::say(const std::string& phrase) {
  const double confidence =
      random_.normal(1.0 - error_model_->voice_doubt, error_model_->voice_doubt_sd);
  phrases.push_back({phrase, std::clamp(confidence, 0.0, 1.0), now_});
}

Vec3 SurgeonBody::pointer_axis(Vec3 surface_normal) const {
  const Vec3 view = posture_.head.from_gaze;
  const Vec3 sideways = Vec3{view.x, 0.0, view.z}.normalized();
  return (0.9 * kUp - 0.42 * sideways + 0.35 * surface_normal).normalized();
}

Vec3 SurgeonBody::best_view(Vec3 axis, std::optional<Vec3> beside) {
  Vec3 best;
  double least = 1e9;
  for (double azimuth = -80.0; azimuth <= 80.0; azimuth += 10.0) {
    for (double elevation = 35.0; elevation <= 65.0; elevation += 5.0) {
      const Vec3 view{
          std::cos(elevation * kRadiansPerDegree) * std::cos(azimuth * kRadiansPerDegree),
          std::sin(elevation * kRadiansPerDegree),
          std::cos(elevation * kRadiansPerDegree) * std::sin(azimuth * kRadiansPerDegree)};
      const double too_steep =
          std::max(0.0, 58.0 - angle_between_rad(view, axis) / kRadiansPerDegree) / 8.0;
      const double too_flat =
          beside ? std::max(0.0, angle_between_rad(view, *beside) / kRadiansPerDegree - 60.0) / 4.0
                 : 0.0;
      const double cost = too_steep * too_steep + too_flat * too_flat +
                          std::pow((elevation - 50.0) / 15.0, 2) + std::pow(azimuth / 40.0, 2);
      if (cost >= least) {
        continue;
      }
      least = cost;
      best = view;
    }
  }
  return best;
}

}  // namespace orthonav::sim
