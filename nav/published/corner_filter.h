#pragma once

#include <array>

#include "base/time.h"
#include "base/vec.h"

namespace orthonav::nav::published {

/// The paper states none of them.
struct CornerFilterOptions {
  /// Spectral density of the white acceleration, px²/s³ (Bar-Shalom, Li & Kirubarajan 2001, 6.2.2):
  /// the least with which the filter follows a stroke of 25 px, once a second, within the noise of
  /// one measurement (lag 0.09 px; with a fifth of it 0.29 px). Tremor is that much smoothed, and
  /// the noise of a tag at rest by 8 %.
  double acceleration_px2_per_s3 = 2000.0;
  /// SD of a measured corner coordinate, px.
  double noise_px = 0.1;
};

/// A constant-velocity Kalman filter for each of the four corners of one tag in one camera
/// (Liebmann et al. 2019, section 3.1). With equal noise and equal history all eight coordinates
/// share their covariance, so it is kept once.
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

}  // namespace orthonav::nav::published
