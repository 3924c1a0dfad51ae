#include "hal/sim/surgeon/head_motion.h"

namespace orthonav::sim {
namespace {

/// A head reaches its goal after about two seconds.
constexpr double kStiffness_rad_s = 3.0;
/// Postural sway of a standing person lies below half a hertz (Winter 1995).
constexpr double kSlowestSway_hz = 0.05;
constexpr double kFastestSway_hz = 0.5;

void follow(Vec3& value, Vec3& speed, Vec3 goal, double step_s) {
  const Vec3 pull = kStiffness_rad_s * kStiffness_rad_s * (goal - value);
  speed += step_s * (pull - 2.0 * kStiffness_rad_s * speed);
  value += step_s * speed;
}

}  // namespace

HeadMotion::HeadMotion(const Random& random, const ErrorModel& error_model, Vec3 eyes_in_rig,
                       const HeadGoal& start)
    : eyes_in_rig_(eyes_in_rig),
      now_(start),
      sway_m_(random.fork("sway position"), error_model.head_sway_m, kSlowestSway_hz,
              kFastestSway_hz),
      sway_rad_(random.fork("sway rotation"), error_model.head_sway_rad, kSlowestSway_hz,
                kFastestSway_hz) {}

void HeadMotion::advance(double step_s, const HeadGoal& goal) {
  follow(now_.gaze.v, gaze_speed_, goal.gaze.v, step_s);
  follow(now_.from_gaze, angular_speed_, goal.from_gaze, step_s);
}

Transform<Room, Rig> HeadMotion::pose(double time_s) const {
  // The rig looks along its -z.
  const Vec3 z = now_.from_gaze.normalized();
  const Vec3 x = Vec3{0, 1, 0}.cross(z).normalized();
  const Mat3 looking = Mat3::from_columns(x, z.cross(x), z);
  const Mat3 rotation = looking * rotation_from_vector(sway_rad_.at(time_s));
  const Vec3 eyes = now_.gaze.v + kDistance_m * z + sway_m_.at(time_s);
  return {rotation, eyes - rotation * eyes_in_rig_};
}

}  // namespace orthonav::sim
