#pragma once

#include <array>

#include "base/tracked.h"
#include "base/transform.h"

namespace orthonav::nav {

/// A Kalman filter on SE(3) with constant velocity (Bar-Shalom, Li & Kirubarajan 2001, 6.2.2; the
/// error is a translation and a left-multiplied rotation vector, Sola et al. 2018), in World. It
/// knows two motions, rest and hand, and assumes rest for as long as the measurements allow.
class PoseFilter {
 public:
  using Pose = Transform<World, Marker>;

  [[nodiscard]] bool alive() const { return alive_; }
  void stop() { alive_ = false; }
  [[nodiscard]] Timestamp time() const { return time_; }
  /// Whether it is alive and its newest measurement is at most `coast` older than `time`.
  [[nodiscard]] bool follows(Timestamp time, Duration coast) const {
    return alive_ && time > time_ && time - time_ <= coast;
  }

  /// Where the tool is at a later time; `alive` must hold.
  [[nodiscard]] Tracked<Pose> predicted(Timestamp time) const;
  /// Adds a measurement with its covariance in World. A measurement is a mean over an exposure,
  /// which under acceleration is not the pose at its middle. Starts the filter when it is not
  /// alive.
  void update(const Tracked<Pose>& measured, double exposure_s);
  /// The pose at the newest measurement, with the lasting part of its error in the covariance.
  [[nodiscard]] Tracked<Pose> state() const;

 private:
  /// Position, rotation, velocity, angular velocity.
  static constexpr int kSize = 12;
  using Covariance = std::array<double, kSize * kSize>;

  void start(const Tracked<Pose>& measured);
  [[nodiscard]] Covariance grown(double dt_s, double density_m, double density_rad) const;

  bool alive_ = false;
  Timestamp time_{};
  Pose pose_;
  Vec3 velocity_m_{};
  Vec3 velocity_rad_{};
  Covariance covariance_{};
  PoseCovariance lasting_{};
};

}  // namespace orthonav::nav
