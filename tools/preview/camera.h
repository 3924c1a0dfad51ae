#pragma once

#include "base/transform.h"
#include "hal/sim/room/room.h"

namespace orthonav::preview {

/// Where the stage is looked at from: the surgeon's eye, or a point that the mouse moves around the
/// site. The stage's +y is up; lengths in metres.
class Camera {
 public:
  [[nodiscard]] bool orbits() const { return orbits_; }
  /// Leaves the surgeon's head and orbits what lies in front of this eye, starting from there.
  void start_orbit(const Transform<sim::Room, Eye>& stage_from_eye);
  void end_orbit() { orbits_ = false; }

  /// Turns around the site for a drag by this fraction of the picture's height, to the right and
  /// down. Only while orbiting.
  void orbit(Vec2 by);
  /// Moves the point looked at with the mouse.
  void pan(Vec2 by);
  /// Orbiting: moves closer; with the eye: magnifies.
  void zoom(double steps);

  /// Where the orbiting camera is.
  [[nodiscard]] Transform<sim::Room, Eye> stage_from_eye() const;
  /// How much narrower the view through the eye is.
  [[nodiscard]] double magnification() const { return orbits_ ? 1.0 : magnification_; }
  friend bool operator==(const Camera&, const Camera&) = default;

 private:
  bool orbits_ = false;
  Vec3 focus_{};
  double distance_m_ = 0.45;
  double yaw_rad_ = 0.0;    ///< about +y; 0 looks along -z
  double pitch_rad_ = 0.0;  ///< positive looks down
  double magnification_ = 1.0;
};

}  // namespace orthonav::preview
