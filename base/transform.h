#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/result.h"
#include "base/vec.h"

namespace orthonav {

// The frames; docs/frames.md gives origin, axes and publisher of each. All right-handed.
struct World;        ///< the headset's map: +y up, metres; it drifts
struct Rig;          ///< the headset
struct LeftCamera;   ///< vision axes: x right, y down, z forward (as the raw image lies)
struct RightCamera;  ///< as LeftCamera
struct DepthSensor;  ///< a depth camera: as LeftCamera
struct Marker;       ///< a tag: x right, y up as the upright tag is seen, z out of its face
struct Tag;          ///< a further tag on a rigid tool: axes as Marker
struct Vertebra;     ///< a preoperative model, axes LPS
struct Spine;        ///< all levels in their common position, axes LPS
struct Eye;          ///< a display eye: x right, y up, -z forward

/// A position expressed in frame A, metres.
template <class A>
struct Point {
  Vec3 v{};

  friend constexpr Vec3 operator-(Point a, Point b) { return a.v - b.v; }
  friend constexpr Point operator+(Point a, Vec3 d) { return {a.v + d}; }
  friend constexpr Point operator-(Point a, Vec3 d) { return {a.v - d}; }
  friend constexpr bool operator==(Point, Point) = default;
};

/// A direction expressed in frame A: rotated by a transform, never translated.
template <class A>
struct Direction {
  Vec3 v{};
  friend constexpr bool operator==(Direction, Direction) = default;
};

/// a_from_b: takes coordinates in B to coordinates in A. Inner letters cancel, or it does not
/// compile: Transform<A,B> * Transform<B,C> is Transform<A,C>.
template <class A, class B>
class Transform {
 public:
  static constexpr double kExact = 1e-9;

  constexpr Transform() = default;
  /// `rotation` must be a rotation already; numbers from outside enter through `checked`.
  constexpr Transform(const Mat3& rotation, Vec3 translation_m)
      : rotation_(rotation), translation_(translation_m) {}

  /// Refuses a matrix that is not a rigid motion: non-finite, not orthonormal within `tolerance`,
  /// or mirrored. A rotation that is orthonormal within kExact is kept to the bit, so that a
  /// recorded pose comes back unchanged; a rougher one is orthonormalized.
  static Result<Transform> checked(const Mat3& rotation, Vec3 translation_m,
                                   double tolerance = 1e-2) {
    bool finite = translation_m.is_finite();
    for (int r = 0; r < 3; ++r) {
      finite = finite && rotation.row(r).is_finite();
    }
    if (!finite) {
      return Error{"transform holds a number that is not finite"};
    }
    if (rotation.determinant() < 0.0) {
      return Error{"transform mirrors (determinant " + std::to_string(rotation.determinant()) +
                   ", must be +1)"};
    }
    const double deviation = orthonormality_error(rotation);
    if (!(deviation <= tolerance)) {
      return Error{"transform is not rigid (rows deviate from orthonormal by " +
                   std::to_string(deviation) + ", limit " + std::to_string(tolerance) + ")"};
    }
    if (deviation <= kExact) {
      return Transform(rotation, translation_m);
    }
    return Transform(orthonormalized(rotation), translation_m);
  }
  /// Row-major 4×4 for column vectors (translation in the last column), metres.
  static Result<Transform> from_row_major(const std::array<double, 16>& a,
                                          double tolerance = 1e-2) {
    return checked({{{{a[0], a[1], a[2]}, {a[4], a[5], a[6]}, {a[8], a[9], a[10]}}}},
                   {a[3], a[7], a[11]}, tolerance);
  }
  [[nodiscard]] constexpr std::array<double, 16> row_major() const {
    const Mat3& r = rotation_;
    const Vec3 t = translation_;
    return {r[0][0], r[0][1], r[0][2], t.x, r[1][0], r[1][1], r[1][2], t.y,
            r[2][0], r[2][1], r[2][2], t.z, 0,       0,       0,       1};
  }

  [[nodiscard]] constexpr const Mat3& rotation() const { return rotation_; }
  [[nodiscard]] constexpr Vec3 translation() const { return translation_; }
  [[nodiscard]] constexpr Point<A> origin() const { return {translation_}; }
  [[nodiscard]] constexpr Transform<B, A> inverse() const {
    const Mat3 rt = rotation_.transposed();
    return {rt, -(rt * translation_)};
  }

  template <class C>
  friend constexpr Transform<A, C> operator*(const Transform& ab, const Transform<B, C>& bc) {
    return {ab.rotation_ * bc.rotation(), ab.rotation_ * bc.translation() + ab.translation_};
  }
  friend constexpr Point<A> operator*(const Transform& ab, Point<B> p) {
    return {ab.rotation_ * p.v + ab.translation_};
  }
  friend constexpr Direction<A> operator*(const Transform& ab, Direction<B> d) {
    return {ab.rotation_ * d.v};
  }
  friend constexpr bool operator==(const Transform&, const Transform&) = default;

 private:
  Mat3 rotation_ = Mat3::identity();
  Vec3 translation_{};
};

/// The pose `fraction` of the way from a (0) to b (1): straight in position, constant angular
/// velocity in rotation. Fractions outside [0, 1] extrapolate.
template <class A, class B>
[[nodiscard]] Transform<A, B> interpolated(const Transform<A, B>& a, const Transform<A, B>& b,
                                           double fraction) {
  const Vec3 rotation_rad = vector_from_rotation(a.rotation().transposed() * b.rotation());
  return {a.rotation() * rotation_from_vector(fraction * rotation_rad),
          a.translation() + fraction * (b.translation() - a.translation())};
}

}  // namespace orthonav
