#pragma once

#include <cstddef>

#include "base/tracked.h"
#include "base/transform.h"
#include "base/vec.h"

// Between our values and another library's vectors and matrices, whose types stay out of headers:
// `m(r, c)` is an entry. And what a small motion does to a pose.
namespace orthonav::nav {

template <class Vector3>
[[nodiscard]] Vector3 vector_as(Vec3 v) {
  return {v.x, v.y, v.z};
}

template <class Vector3>
[[nodiscard]] Vec3 vec_of(const Vector3& v) {
  return {v(0), v(1), v(2)};
}

template <class Matrix3>
[[nodiscard]] Matrix3 matrix_as(const Mat3& m) {
  Matrix3 out;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      out(r, c) = m.m[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
    }
  }
  return out;
}

/// The matrix of the cross product: skew(v)·u = v × u.
template <class Matrix3>
[[nodiscard]] Matrix3 skew_as(Vec3 v) {
  Matrix3 out;
  out << 0, -v.z, v.y, v.z, 0, -v.x, -v.y, v.x, 0;
  return out;
}

/// The pose after a translation and a rotation about its own origin, both in frame A.
template <class A, class B>
[[nodiscard]] Transform<A, B> displaced(const Transform<A, B>& pose, Vec3 translation_m,
                                        Vec3 rotation_rad) {
  return {orthonormalized(rotation_from_vector(rotation_rad) * pose.rotation()),
          pose.translation() + translation_m};
}

/// Symmetrizes a 6×6 covariance that is symmetric up to rounding: the mean of it and its transpose.
template <class Matrix6>
[[nodiscard]] PoseCovariance symmetrized(const Matrix6& m) {
  PoseCovariance out;
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c < 6; ++c) {
      out[static_cast<std::size_t>(6 * r + c)] = 0.5 * (m(r, c) + m(c, r));
    }
  }
  return out;
}

}  // namespace orthonav::nav
