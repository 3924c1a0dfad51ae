#pragma once

#include <array>
#include <cstddef>

#include "base/tracked.h"
#include "base/transform.h"
#include "base/vec.h"

// Between our values and another library's vectors and matrices, whose types stay out of headers:
// `m(r, c)` is an entry. And what a small motion does to a place and to a pose.
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

template <class Matrix3>
[[nodiscard]] Mat3 mat_of(const Matrix3& m) {
  return Mat3::from_columns(vec_of(m.col(0)), vec_of(m.col(1)), vec_of(m.col(2)));
}

/// The matrix of the cross product: skew(v)·u = v × u.
template <class Matrix3>
[[nodiscard]] Matrix3 skew_as(Vec3 v) {
  Matrix3 out;
  out << 0, -v.z, v.y, v.z, 0, -v.x, -v.y, v.x, 0;
  return out;
}

/// A 3×3 or 6×6 matrix that values hold by rows, and back.
template <class Matrix, std::size_t N>
[[nodiscard]] Matrix matrix_as(const std::array<double, N>& rows) {
  constexpr std::size_t kSize = N == 9 ? 3 : 6;
  static_assert(N == kSize * kSize);
  Matrix out;
  for (std::size_t i = 0; i < N; ++i) {
    out(static_cast<int>(i / kSize), static_cast<int>(i % kSize)) = rows[i];
  }
  return out;
}
template <std::size_t N, class Matrix>
[[nodiscard]] std::array<double, N> rows_of(const Matrix& m) {
  constexpr std::size_t kSize = N == 9 ? 3 : 6;
  static_assert(N == kSize * kSize);
  std::array<double, N> out{};
  for (std::size_t i = 0; i < N; ++i) {
    out[i] = m(static_cast<int>(i / kSize), static_cast<int>(i % kSize));
  }
  return out;
}

/// Times a small motion (translation, rotation vector) about a centre: by how much a place moves.
template <class Matrix3x6>
[[nodiscard]] Matrix3x6 moves_as(Vec3 from_centre_m) {
  const Vec3 d = from_centre_m;
  Matrix3x6 out;
  out << 1, 0, 0, 0, d.z, -d.y,  //
      0, 1, 0, -d.z, 0, d.x,     //
      0, 0, 1, d.y, -d.x, 0;
  return out;
}

/// dᵀ·C·d for a 3×3 covariance: the variance along d, if that has unit length.
[[nodiscard]] inline double variance_along(const std::array<double, 9>& covariance,
                                           Vec3 direction) {
  double variance = 0.0;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      variance += direction[r] * covariance[static_cast<std::size_t>(3 * r + c)] * direction[c];
    }
  }
  return variance;
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
  return rows_of<36>(Matrix6(0.5 * (m + m.transpose())));
}

}  // namespace orthonav::nav
