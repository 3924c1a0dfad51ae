#pragma once

#include <array>
#include <cmath>

namespace orthonav {

/// A pair of numbers; the owner says whether pixels (`_px`) or unit-plane coordinates.
struct Vec2 {
  double x = 0.0;
  double y = 0.0;

  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
  friend constexpr Vec2 operator*(Vec2 a, double s) { return s * a; }
  friend constexpr bool operator==(Vec2, Vec2) = default;
  [[nodiscard]] constexpr double dot(Vec2 o) const { return x * o.x + y * o.y; }
  /// The z of the cross product: twice the signed area of the triangle between them.
  [[nodiscard]] constexpr double cross(Vec2 o) const { return x * o.y - y * o.x; }
  [[nodiscard]] double norm() const { return std::sqrt(dot(*this)); }
};

/// Three numbers without a frame: a direction, or the inside of a Point. Metres unless named.
struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
  friend constexpr Vec3 operator*(Vec3 a, double s) { return s * a; }
  friend constexpr Vec3 operator/(Vec3 a, double s) { return {a.x / s, a.y / s, a.z / s}; }
  friend constexpr bool operator==(Vec3, Vec3) = default;
  constexpr Vec3& operator+=(Vec3 o) { return *this = *this + o; }
  constexpr Vec3& operator-=(Vec3 o) { return *this = *this - o; }
  constexpr double& operator[](int i) { return i == 0 ? x : (i == 1 ? y : z); }
  constexpr double operator[](int i) const { return i == 0 ? x : (i == 1 ? y : z); }

  [[nodiscard]] constexpr double dot(Vec3 o) const { return x * o.x + y * o.y + z * o.z; }
  [[nodiscard]] constexpr Vec3 cross(Vec3 o) const {
    return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x};
  }
  [[nodiscard]] constexpr double squared_norm() const { return dot(*this); }
  [[nodiscard]] double norm() const { return std::sqrt(squared_norm()); }
  /// The unit vector; the vector itself must not be zero.
  [[nodiscard]] Vec3 normalized() const { return *this / norm(); }
  [[nodiscard]] bool is_finite() const {
    return std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
  }
};

/// The angle between two directions in [0, pi] rad; acos would lose half its digits near zero.
[[nodiscard]] inline double angle_between_rad(Vec3 a, Vec3 b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// 3×3 matrix, row-major: m[row][column].
struct Mat3 {
  std::array<std::array<double, 3>, 3> m{};

  static constexpr Mat3 identity() { return {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}; }
  static constexpr Mat3 from_columns(Vec3 a, Vec3 b, Vec3 c) {
    return {{{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}}}};
  }
  constexpr std::array<double, 3>& operator[](int r) { return m[static_cast<std::size_t>(r)]; }
  constexpr const std::array<double, 3>& operator[](int r) const {
    return m[static_cast<std::size_t>(r)];
  }
  [[nodiscard]] constexpr Vec3 row(int r) const {
    return {(*this)[r][0], (*this)[r][1], (*this)[r][2]};
  }
  [[nodiscard]] constexpr Vec3 column(std::size_t c) const { return {m[0][c], m[1][c], m[2][c]}; }
  [[nodiscard]] constexpr Mat3 transposed() const { return from_columns(row(0), row(1), row(2)); }
  [[nodiscard]] constexpr double determinant() const { return row(0).dot(row(1).cross(row(2))); }
  friend constexpr Vec3 operator*(const Mat3& a, Vec3 v) {
    return {a.row(0).dot(v), a.row(1).dot(v), a.row(2).dot(v)};
  }
  friend constexpr Mat3 operator*(const Mat3& a, const Mat3& b) {
    return from_columns(a * b.column(0), a * b.column(1), a * b.column(2));
  }
  friend constexpr bool operator==(const Mat3&, const Mat3&) = default;
};

/// Unit quaternion, Hamilton convention, w last as in the files.
struct Quaternion {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double w = 1.0;
};

/// Rotation vector (axis times angle, rad) to matrix and back (Rodrigues).
[[nodiscard]] Mat3 rotation_from_vector(Vec3 axis_angle_rad);
[[nodiscard]] Vec3 vector_from_rotation(const Mat3& rotation);
[[nodiscard]] Mat3 rotation_from_quaternion(Quaternion q);
/// w ≥ 0, so that one rotation has one quaternion.
[[nodiscard]] Quaternion quaternion_from_rotation(const Mat3& rotation);
/// The rotation nearest to a matrix that is almost one: Gram-Schmidt on the rows, the first kept.
[[nodiscard]] Mat3 orthonormalized(const Mat3& nearly_rotation);
/// Largest deviation of M·Mᵀ from the identity; 0 for a rotation or a mirrored one.
[[nodiscard]] double orthonormality_error(const Mat3& matrix);
/// Angle of the rotation between two orientations, rad.
[[nodiscard]] double rotation_angle_rad(const Mat3& a, const Mat3& b);

}  // namespace orthonav
