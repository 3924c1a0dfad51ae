#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "hal/sim/surgeon.h"

namespace orthonav::sim {
namespace {

constexpr double kRad = std::numbers::pi / 180.0;
constexpr double kLook_s = 0.6;
constexpr double kMoveHead_s = 2.0;
constexpr double kPatience_s = 300.0;
// Turning: visual reaction, how fast a seen deviation is taken out, and how steady it must be.
constexpr double kReaction_s = 0.25;
constexpr double kGain_per_s = 1.6;
constexpr double kSteady_s = 0.7;
constexpr double kHold_s = 0.8;
constexpr int kFewestReadings = 5;
/// Half the last digit of the readout: a zero can't be told from this.
constexpr double kReadoutFloor_rad = 0.05 * kRad;
/// Nobody turns for ever: after a while the surgeon is content with more.
constexpr double kStrict_s = 6.0;
constexpr double kDoublesEvery_s = 4.0;
constexpr double kOverBone_m = 0.030;
constexpr double kBoneSearch_m = 0.015;
constexpr double kDriving_s = 3.5;
constexpr double kAdvance_m = 0.010;

/// The head's place from which a tool along `axis` shows its tag well and the surgeon still
/// stands at the side of the table.
Vec3 best_view(Vec3 axis) {
  Vec3 best;
  double least = 1e9;
  for (double azimuth = -80.0; azimuth <= 80.0; azimuth += 10.0)
    for (double elevation = 35.0; elevation <= 65.0; elevation += 5.0) {
      const Vec3 view{std::cos(elevation * kRad) * std::cos(azimuth * kRad),
                      std::sin(elevation * kRad),
                      std::cos(elevation * kRad) * std::sin(azimuth * kRad)};
      const double too_steep = std::max(0.0, 58.0 - angle_between_rad(view, axis) / kRad) / 8.0;
      const double cost = too_steep * too_steep + std::pow((elevation - 50.0) / 15.0, 2) +
                          std::pow(azimuth / 40.0, 2);
      if (cost >= least) continue;
      least = cost;
      best = view;
    }
  return best;
}

/// The number on the readout, in rad; nothing when it shows dashes.
std::optional<double> readout_rad(const std::string& text) {
  char* end = nullptr;
  const double degrees = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || !std::isfinite(degrees) || degrees < 0.0) return std::nullopt;
  return degrees * kRad;
}

/// The last second of deviations, oldest overwritten.
template <class T>
class Memory {
 public:
  void add(const T& reading) { readings_[count_++ % kSize] = reading; }
  /// The newest seen at or before `until`.
  [[nodiscard]] std::optional<T> newest(Timestamp until) const {
    for (std::size_t back = 0; back < size(); ++back) {
      const T& reading = readings_[(count_ - 1 - back) % kSize];
      if (reading.seen_at <= until) return reading;
    }
    return std::nullopt;
  }
  /// The mean of those seen since; nothing when they don't reach back that far.
  [[nodiscard]] std::optional<Vec3> mean_since(Timestamp since) const {
    Vec3 sum;
    int used = 0;
    for (std::size_t back = 0; back < size(); ++back) {
      const T& reading = readings_[(count_ - 1 - back) % kSize];
      if (reading.seen_at < since) return used > 0 ? std::optional(sum / used) : std::nullopt;
      sum += reading.turn;
      ++used;
    }
    return std::nullopt;
  }
  void clear() { count_ = 0; }

 private:
  static constexpr std::size_t kSize = 256;
  [[nodiscard]] std::size_t size() const { return std::min(count_, kSize); }
  std::array<T, kSize> readings_{};
  std::size_t count_ = 0;
};

}  // namespace

Script Surgeon::guide(std::size_t level, std::string side) {
  const std::string step(eyes_->step());
  if (!driven_.contains(step)) {
    const std::string label = layout_->room().levels[level].label + " " + side;
    co_await body_.take(ToolKind::kGuide, layout_->site(level));
    Aim aim;
    co_await find_entry(level, label, aim);
    if (!in_step(step) || finished_) co_return;
    // The first guess of the direction is several degrees off.
    const double guess_rad = body_.random().uniform(4.0, 8.0) * kRad;
    const double where = body_.random().uniform(0.0, 2.0 * std::numbers::pi);
    const Vec3 across = perpendicular_to(aim.outwards);
    const Vec3 tilt = std::cos(where) * across + std::sin(where) * aim.outwards.cross(across);
    const Vec3 axis = rotation_from_vector(guess_rad * tilt) * aim.outwards;
    const Point<Room> tip{aim.on_bone.point};
    co_await body_.move({tip + kOverBone_m * axis, axis, 0.0}, 1.2);
    co_await body_.move({tip, axis, 0.0}, 1.2);
    body_.posture().contact_normal = aim.on_bone.normal;
    co_await turn_tool(step, aim);
    if (!in_step(step) || finished_) co_return;
    co_await drive_wire(level, side, aim);
    driven_.insert(step);
  }
  body_.say("next");
}

BoneSpot Surgeon::put_on_bone(std::size_t level, Vec3 entry, Vec3 outwards) const {
  const auto& room_from_vertebra = layout_->room_from_vertebra(level);
  const auto vertebra_from_room = room_from_vertebra.inverse();
  const Vec3 at = (vertebra_from_room * Point<Room>{entry}).v;
  const Vec3 inwards = (vertebra_from_room * Direction<Room>{-outwards}).v;
  const BoneSurface& bone = layout_->bone(level);
  const auto hit = bone.first_hit(at - kBoneSearch_m * inwards, inwards, 2.0 * kBoneSearch_m);
  const BoneSpot spot = hit ? *hit : bone.closest(at);
  return {(room_from_vertebra * Point<Vertebra>{spot.point}).v,
          (room_from_vertebra * Direction<Vertebra>{spot.normal}).v};
}

Script Surgeon::find_entry(std::size_t level, const std::string& label, Aim& aim) {
  const std::string step(eyes_->step());
  const Vec3 perceived_shift = normal_vector(body_.random(), magnitudes_->overlay_perception_m) +
                               normal_vector(body_.random(), magnitudes_->entry_pick_m);
  // First a glance for the direction, to stand right; then a look for the place.
  for (const bool glance : {true, false}) {
    Vec3 entry;
    Vec3 outwards;
    Duration looked{};
    const Timestamp patience = body_.now() + from_seconds(kPatience_s);
    int frames = 0;
    for (Timestamp before = body_.now(); looked < from_seconds(glance ? 0.1 : kLook_s);
         before = body_.now()) {
      co_await body_.next_tick();
      if (!in_step(step)) co_return;
      if (body_.now() > patience) {
        give_up();
        co_return;
      }
      const ShownHologram* spot = eyes_->find("H3", label);
      const ShownHologram* path = eyes_->find("H4");
      if (!sees_now() || !spot || spot->points_in_world.empty() || !path ||
          path->points_in_world.size() < 3)
        continue;
      const Vec3 axis =
          eyes_->place(path->points_in_world[0]) - eyes_->place(path->points_in_world[2]);
      if (!(axis.norm() > 1e-3) || !spot->points_in_world[0].v.is_finite()) continue;
      entry += eyes_->place(spot->points_in_world[0]).v;
      outwards += axis.normalized();
      looked += body_.now() - before;
      ++frames;
    }
    aim.outwards = outwards.normalized();
    aim.on_bone = put_on_bone(level, entry / frames + perceived_shift, aim.outwards);
    body_.look({aim.on_bone.point}, best_view(aim.outwards));
    if (glance) co_await body_.rest(kMoveHead_s);
  }
}

std::optional<Surgeon::Deviation> Surgeon::read_deviation() const {
  const ShownHologram* triangle = eyes_->find("H5");
  const ShownHologram* number = eyes_->find("H6");
  if (!sees_now() || !triangle || triangle->points_in_world.size() != 3 || !number ||
      !readout_rad(number->text))
    return std::nullopt;
  const Point<Room> a = eyes_->place(triangle->points_in_world[0]);
  const Vec3 tool = eyes_->place(triangle->points_in_world[1]) - a;
  const Vec3 planned = eyes_->place(triangle->points_in_world[2]) - a;
  if (!(tool.norm() > 1e-3 && planned.norm() > 1e-3)) return std::nullopt;
  const Vec3 axis = tool.cross(planned);
  const double angle_rad = angle_between_rad(tool, planned);
  // A triangle and a number that disagree are both wrong.
  if (std::abs(angle_rad - *readout_rad(number->text)) > 1.0 * kRad) return std::nullopt;
  const Vec3 turn = axis.norm() > 0.0 ? angle_rad * axis.normalized() : Vec3{};
  return Deviation{*eyes_->seen_at(), turn};
}

Script Surgeon::turn_tool(const std::string& step, const Aim& aim) {
  Memory<Deviation> memory;
  const double patient_rad = std::max(magnitudes_->angle_reading_rad, kReadoutFloor_rad);
  Timestamp last_seen = body_.now();
  Timestamp before = body_.now();
  double turning_s = 0.0;
  while (in_step(step)) {
    co_await body_.next_tick();
    const double tick_s = seconds(body_.now() - before);
    before = body_.now();
    const auto reading = read_deviation();
    const double lost_s = seconds(body_.now() - last_seen);
    if (!reading) {
      // Turns the tag to and fro and leans over, so that the cameras find it again.
      if (lost_s > 1.0) {
        memory.clear();
        body_.posture().grip.roll_rad = 0.35 * std::sin(2.0 * (lost_s - 1.0));
        const double lean = 0.25 * std::sin(0.5 * (lost_s - 1.0));
        body_.look({aim.on_bone.point},
                   rotation_from_vector({0, lean, 0}) * best_view(aim.outwards));
      }
      if (lost_s > kPatience_s) give_up();
      if (finished_) co_return;
      continue;
    }
    if (reading->seen_at != last_seen) memory.add(*reading);
    last_seen = reading->seen_at;
    turning_s += tick_s;
    Grip& grip = body_.posture().grip;
    if (const auto acted_on = memory.newest(body_.now() - from_seconds(kReaction_s)))
      grip.axis =
          (rotation_from_vector(kGain_per_s * tick_s * acted_on->turn) * grip.axis).normalized();
    const double content_rad =
        patient_rad * std::exp2(std::max(0.0, turning_s - kStrict_s) / kDoublesEvery_s);
    const auto mean = memory.mean_since(body_.now() - from_seconds(kSteady_s));
    if (!mean || mean->norm() > content_rad) continue;
    // Steady enough: holds still, reads the average and takes out what is left of it.
    Vec3 left_over;
    int readings = 0;
    co_await body_.rest(kReaction_s / body_.slowness());
    co_await hold_and_average(kHold_s, left_over, readings);
    before = body_.now();
    memory.clear();
    if (readings < kFewestReadings || left_over.norm() > 2.0 * content_rad) continue;
    const Vec3 misread = normal_vector(body_.random(), magnitudes_->angle_reading_rad);
    Grip final_grip = body_.posture().grip;
    final_grip.axis = (rotation_from_vector(left_over + misread) * final_grip.axis).normalized();
    co_await body_.move(final_grip, 0.4);
    co_return;
  }
}

Script Surgeon::hold_and_average(double duration_s, Vec3& mean_turn, int& readings) {
  const Timestamp end = body_.now() + from_seconds(duration_s);
  std::optional<Timestamp> last;
  Vec3 sum;
  readings = 0;
  while (body_.now() < end) {
    co_await body_.next_tick();
    const auto reading = read_deviation();
    if (!reading || reading->seen_at == last) continue;
    last = reading->seen_at;
    sum += reading->turn;
    ++readings;
  }
  if (readings > 0) mean_turn = sum / readings;
}

Script Surgeon::drive_wire(std::size_t level, const std::string& side, const Aim& aim) {
  deeds_.push_back({Deed::Kind::kPierced, level, side});
  body_.posture().contact_normal.reset();
  const Grip pierced = body_.posture().grip;
  Grip deep = pierced;
  deep.tip = pierced.tip - kAdvance_m * pierced.axis;
  co_await body_.move(deep, kDriving_s);
  co_await body_.rest(0.3);
  Grip out = pierced;
  out.tip = Point<Room>{aim.on_bone.point} + kOverBone_m * pierced.axis;
  co_await body_.move(out, 1.0);
}

}  // namespace orthonav::sim
