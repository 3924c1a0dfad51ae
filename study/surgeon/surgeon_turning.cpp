#include <algorithm>
#include <cmath>

#include "base/angle.h"
#include "study/surgeon/deviation.h"
#include "study/surgeon/scripted_surgeon.h"

namespace orthonav::sim {
namespace {

constexpr double kSteady_s = 0.7;
/// How long a number is watched before the last correction.
constexpr double kHold_s = 0.7;
/// If the average is further off than this, turning continues.
constexpr double kLastCorrection_rad = 1.0 * kRadiansPerDegree;
constexpr int kFewestReadings = 5;
/// One digit of the number misread as another.
constexpr double kMisread_rad = 1.0 * kRadiansPerDegree;
constexpr double kLastMove_s = 0.4;
/// Half the last digit of the readout: indistinguishable from zero.
constexpr double kReadoutFloor_rad = 0.05 * kRadiansPerDegree;
/// After this long the surgeon accepts a larger deviation.
constexpr double kStrict_s = 6.0;
constexpr double kDoublesEvery_s = 4.0;
/// For this long they lean only a little to either side.
constexpr double kLeans_s = 6.0;

}  // namespace

Script ScriptedSurgeon::rotate_tool(const StepOnDisplay& step, const Aim& aim) {
  DeviationMemory memory;
  const double strict_rad = std::max(error_model_->angle_reading_rad, kReadoutFloor_rad);
  Timestamp last_seen = body_.now();
  Timestamp before = body_.now();
  double rotating_s = 0.0;
  while (in_step(step) && !finished_) {
    co_await body_.next_tick();
    const double tick_s = seconds(body_.now() - before);
    before = body_.now();
    const auto reading = read_rotation();
    if (!reading) {
      if (regain_reading(aim, seconds(body_.now() - last_seen), tick_s)) {
        memory.clear();
      }
      continue;
    }
    memory.add(*reading);
    last_seen = body_.now();
    rotating_s += tick_s;
    if (const auto acted_on = memory.newest(body_.now() - from_seconds(kReaction_s))) {
      rotate_by(kGain_per_s * tick_s * acted_on->rotation_rad);
    }
    const double content_rad =
        strict_rad * std::exp2(std::max(0.0, rotating_s - kStrict_s) / kDoublesEvery_s);
    const auto mean = memory.mean_since(body_.now() - from_seconds(kSteady_s));
    if (!mean || mean->norm() > content_rad) {
      continue;
    }
    bool settled = false;
    co_await settle(content_rad, settled);
    if (settled) {
      co_return;
    }
    before = body_.now();
    memory.clear();
  }
}

std::optional<Deviation> ScriptedSurgeon::read_rotation() const {
  if (!sees_now()) {
    return std::nullopt;
  }
  return guidance_ == GuidanceProfile::kPublished ? read_triangle(eyes_) : read_deviation(eyes_);
}

void ScriptedSurgeon::rotate_by(Vec3 rotation_rad) {
  Grip& grip = body_.posture().grip;
  grip.axis = (rotation_from_vector(rotation_rad) * grip.axis).normalized();
}

bool ScriptedSurgeon::regain_reading(const Aim& aim, double lost_s, double tick_s) {
  if (lost_s > kLongPatience_s) {
    give_up();
  }
  if (lost_s > kLost_s) {
    show_tag(aim, lost_s - kLost_s, tick_s);
  }
  return lost_s > kLost_s;
}

void ScriptedSurgeon::show_tag(const Aim& aim, double since_s, double tick_s) {
  body_.posture().grip.roll_rad += tick_s * 0.7 * std::cos(2.0 * since_s);
  lean({aim.on_bone.point}, best_view(aim.outwards), since_s);
}

void ScriptedSurgeon::lean(Point<Room> site, Vec3 from, double since_s) {
  // A tag hidden for this long stays hidden from here: the surgeon leans further aside.
  const double reach_rad = std::clamp(0.25 * (since_s - kLeans_s) / kLeans_s, 0.25, 1.0);
  const double aside_rad = reach_rad * std::sin(0.5 * since_s);
  body_.look(site, rotation_from_vector({0, aside_rad, 0}) * from);
}

bool ScriptedSurgeon::lean_where_lost(Point<Room> site, Vec3 from, double lost_s) {
  const bool leans = relies_on_reference_ && lost_s > kLost_s;
  if (leans) {
    lean(site, from, lost_s - kLost_s);
  }
  return leans;
}

Script ScriptedSurgeon::settle(double content_rad, bool& settled) {
  co_await body_.rest(kReaction_s / body_.slowness());
  const Timestamp start = body_.now();
  std::optional<Timestamp> last;
  Vec3 sum;
  int readings = 0;
  for (double done = 0.0; done < 1.0; done = seconds(body_.now() - start) / kHold_s) {
    co_await body_.next_tick();
    const auto reading = read_rotation();
    if (!reading || reading->seen_at == last) {
      continue;
    }
    last = reading->seen_at;
    sum += reading->rotation_rad;
    ++readings;
  }
  const double limit_rad = std::max(2.0 * content_rad, kLastCorrection_rad);
  if (readings < kFewestReadings || sum.norm() > limit_rad * readings) {
    co_return;
  }
  Vec3 misread = normal_vector(body_.random(), error_model_->angle_reading_rad);
  if (body_.random().uniform() < error_model_->misreading_probability) {
    misread = misread + kMisread_rad * perpendicular_to(body_.posture().grip.axis);
  }
  misread_rad_ = misread;
  Grip last_grip = body_.posture().grip;
  last_grip.axis = (rotation_from_vector(sum / readings + misread) * last_grip.axis).normalized();
  co_await body_.move(last_grip, kLastMove_s);
  settled = true;
}

}  // namespace orthonav::sim
