#pragma once

#include "base/transform.h"
#include "hal/sim/room.h"

namespace orthonav::preview {

/// From where the stage is looked at: with the surgeon's eye, or from a point that the mouse takes
/// round the site. The stage's +y is up; lengths in metres.
class Camera {
 public:
  [[nodiscard]] bool orbits() const { return orbits_; }
  /// Leaves the head where it is; looks round what lies before this eye, starting from there.
  void start_orbit(const Transform<sim::Room, Eye>& stage_from_eye);
  void end_orbit() { orbits_ = false; }

  /// Round the site by so much of the picture's height, to the right and down. Only while orbiting.
  void turn(Vec2 by);
  /// Moves what is looked at along with the mouse.
  void pan(Vec2 by);
  /// Orbiting: nearer; with the eye: larger.
  void zoom(double steps);

  /// Where the orbiting camera is.
  [[nodiscard]] Transform<sim::Room, Eye> stage_from_eye() const;
  /// How much narrower the view with the eye is.
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
