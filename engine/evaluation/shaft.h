#pragma once

#include <array>
#include <cmath>

#include "base/transform.h"
#include "engine/evaluation/scan_field.h"

namespace orthonav::engine {

/// The centreline of a shaft: a straight line, or a parabola for a bent wire. `s` runs from -half_m
/// to half_m, metres along `direction`.
struct Centreline {
  Vec3 middle_m;
  Vec3 direction;  ///< unit
  Vec3 across;     ///< unit, at right angles to the direction and to each other
  Vec3 athwart;
  double half_m = 0.0;
  /// How far the line lies off its tangent at either end, towards `across` and `athwart`.
  double bow_across_m = 0.0;
  double bow_athwart_m = 0.0;

  [[nodiscard]] static Centreline straight(Vec3 middle_m, Vec3 direction, double half_m) {
    const Vec3 aside = std::abs(direction.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 across = direction.cross(aside).normalized();
    return {middle_m, direction, across, direction.cross(across), half_m};
  }
  [[nodiscard]] Vec3 at(double s_m) const {
    const double q = (s_m / half_m) * (s_m / half_m);
    return middle_m + s_m * direction + (q * bow_across_m) * across + (q * bow_athwart_m) * athwart;
  }
  [[nodiscard]] Vec3 tangent(double s_m) const {
    const double slope = 2.0 * s_m / (half_m * half_m);
    return (direction + slope * bow_across_m * across + slope * bow_athwart_m * athwart)
        .normalized();
  }
  [[nodiscard]] double s_of(Vec3 place_m) const { return (place_m - middle_m).dot(direction); }
  [[nodiscard]] double off_m(Vec3 place_m) const { return (place_m - at(s_of(place_m))).norm(); }
};

/// Radius below which a shaft is taken for a wire, which may be bent.
inline constexpr double kWire_m = 0.0018;

/// A straight piece of metal in a scan: a screw without its head, a wire, a piece of a rod.
struct Shaft {
  Centreline line;
  double from_s_m = 0.0;  ///< where it begins, or where its head ends
  double to_s_m = 0.0;    ///< its other end: the one further to the front (LPS), taken for the tip
  double radius_m = 0.0;
  bool headed = false;     ///< thicker metal before `from_s_m`
  bool cut = false;        ///< the scan ends before the tip does
  double misfit_hu = 0.0;  ///< RMS residual of the voxels at its border
  /// Of the errors of its middle across and athwart (m²), then of its direction towards these
  /// (rad²), by rows.
  std::array<double, 16> covariance{};

  /// Whether its tip lies at another shaft, or another one's tip at it.
  bool touched = false;
  /// Not where the scan ends before it, or where it lies within another shaft or in cement.
  bool tip_seen = true;
  /// Whether metal continues before `from_s_m`, so that it is not an end.
  bool goes_on = false;

  [[nodiscard]] Point<Scan> tip() const { return {line.at(to_s_m)}; }
  [[nodiscard]] Point<Scan> rear() const { return {line.at(from_s_m)}; }
  [[nodiscard]] double length_m() const { return to_s_m - from_s_m; }
  [[nodiscard]] bool is_wire() const { return radius_m < kWire_m; }
};

/// Whether the tip of a shaft lies against another one, or within 2 mm of it.
[[nodiscard]] inline bool tip_touches(const Shaft& shaft, const Shaft& other) {
  constexpr double kNear_m = 0.002;
  const Vec3 tip = shaft.tip().v;
  const double s = other.line.s_of(tip);
  return s > other.from_s_m - kNear_m && s < other.to_s_m + kNear_m &&
         other.line.off_m(tip) < shaft.radius_m + other.radius_m + kNear_m;
}

}  // namespace orthonav::engine
