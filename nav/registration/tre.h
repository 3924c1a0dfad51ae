#pragma once

#include <array>
#include <span>

#include "base/tracked.h"
#include "base/transform.h"

namespace orthonav::nav {

/// How far a registration leaves the bone free to move, and so the error to expect at a target
/// (Fitzpatrick & West 2001, "The distribution of target registration error in rigid-body
/// point-based registration", of a pose with any covariance). Errors common to all points are added
/// by `with_common`.
class PoseUncertainty {
 public:
  PoseUncertainty() = default;
  /// The covariance of the bone's (translation m, rotation vector rad) about a centre, row-major,
  /// in the model's frame.
  PoseUncertainty(Vec3 centre_m, const std::array<double, 36>& covariance)
      : centre_m_(centre_m), covariance_(covariance) {}

  /// Root mean square of the error to expect at a target, metres.
  [[nodiscard]] double predicted_tre_m(Point<Vertebra> target) const;
  /// Covariance of the error at a target, 3x3 by rows, m², in the model's frame.
  [[nodiscard]] std::array<double, 9> covariance_at(Point<Vertebra> target) const;
  /// Covariance of the rotation vector alone, 3x3 by rows, rad².
  [[nodiscard]] std::array<double, 9> rotation_covariance() const;
  /// The error at a target is smaller with this probability (the distribution of a weighted sum of
  /// squares by Satterthwaite 1946, its quantile by Wilson & Hilferty 1931).
  [[nodiscard]] double tre_quantile_m(Point<Vertebra> target, double probability) const;
  [[nodiscard]] Vec3 centre_m() const { return centre_m_; }
  [[nodiscard]] const std::array<double, 36>& covariance() const { return covariance_; }

 private:
  Vec3 centre_m_;  ///< of the points, in the model's frame
  std::array<double, 36>
      covariance_{};  ///< row-major, of (translation m, rotation rad) about the centre
};

/// The largest root mean square of the errors to expect at these targets, metres.
[[nodiscard]] double worst_tre_m(const PoseUncertainty& uncertainty,
                                 std::span<const Point<Vertebra>> targets);

/// SD along each axis of errors that shift all points equally, by source; 0 if unknown. Residuals
/// do not show them.
struct CommonErrors {
  double tip_m = 0.0;      ///< of the pointer's tip, from its calibration
  double cameras_m = 0.0;  ///< of the position at which calibrated cameras see a tool
  double map_m = 0.0;      ///< of World relative to the patient since the bone was stroked
  /// The SD of all of them together, along each axis.
  [[nodiscard]] double sd_m() const;
};
/// Adds common errors to an uncertainty, and removes them again.
[[nodiscard]] PoseUncertainty with_common(const PoseUncertainty& own, const CommonErrors& common);
[[nodiscard]] PoseUncertainty without_common(const PoseUncertainty& all,
                                             const CommonErrors& common);
/// Adds to an uncertainty a rotation about a place, of this SD about each direction across `axis`
/// (unit).
[[nodiscard]] PoseUncertainty with_turn(const PoseUncertainty& own, Point<Vertebra> about,
                                        Vec3 axis, double sd_rad);
/// The uncertainty of a tracked tool's pose relative to the bone, from the uncertainties of both
/// poses. They are taken as independent: errors that strokes and tool share (the cameras, the map)
/// must not be in `bone`, or they are counted although they cancel. `origin_in_vertebra` is the
/// origin of the tracked marker, about which the rotations in its covariance (World's axes) are
/// taken.
[[nodiscard]] PoseUncertainty with_tool(const PoseUncertainty& bone,
                                        const Transform<Vertebra, World>& vertebra_from_world,
                                        Point<Vertebra> origin_in_vertebra,
                                        const PoseCovariance& tool_in_world);

}  // namespace orthonav::nav
