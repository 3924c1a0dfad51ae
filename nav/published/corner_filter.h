#pragma once

#include <array>

#include "base/time.h"
#include "base/vec.h"

namespace orthonav::nav {

struct CornerFilterOptions {
  /// Spectral density of the white acceleration, px²/s³ (Bar-Shalom, Li & Kirubarajan 2001, 6.2.2).
  double acceleration_px = 400.0;
  /// SD of a measured corner coordinate, px.
  double noise_px = 0.1;
  /// SD of the velocity of a newly visible tag, px/s.
  double first_velocity_px = 400.0;
};

/// Constant-velocity Kalman filters for the four corners of one tag in one camera. Corners are
/// filtered independently; with equal noise and equal history all eight coordinates share their
/// covariance, so it is kept once. If the innovations of the whole tag exceed what the model
/// allows, the prediction's covariance is inflated to fit them (a strong tracking filter: Zhou &
/// Frank 1996), so that a sudden start or turn of the hand isn't smoothed away.
class CornerFilter {
 public:
  using Corners = std::array<Vec2, 4>;

  CornerFilter() = default;
  explicit CornerFilter(const CornerFilterOptions& options) : options_(options) {}

  [[nodiscard]] bool alive() const { return alive_; }
  [[nodiscard]] Timestamp time() const { return time_; }
  [[nodiscard]] const Corners& corners_px() const { return position_px_; }
  /// Variance of one corner coordinate, px².
  [[nodiscard]] double variance_px2() const { return position_variance_; }

  /// Forgets everything.
  void stop() { alive_ = false; }
  /// Adds a measurement; restarts if there is none before it, if time does not increase, or if the
  /// tag jumped farther than it could move.
  void update(const Corners& measured_px, Timestamp time);

  struct Prediction {
    Corners corners_px;
    double sd_px = 0.0;  ///< of one coordinate
  };
  /// Where the corners will be at a later time.
  [[nodiscard]] Prediction predicted(Timestamp time) const;

 private:
  void start(const Corners& measured_px, Timestamp time);
  void advance(double dt_s);
  void correct(const Corners& measured_px);

  CornerFilterOptions options_;
  bool alive_ = false;
  Timestamp time_{};
  Corners position_px_{};
  Corners velocity_px_{};
  double position_variance_ = 0.0;
  double covariance_ = 0.0;
  double velocity_variance_ = 0.0;
};

}  // namespace orthonav::nav
