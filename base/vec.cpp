#include "base/vec.h"

#include <algorithm>

namespace orthonav {

Mat3 rotation_from_vector(Vec3 v) {
  const double angle = v.norm();
  // sin(t)/t and (1-cos t)/t² by series below 1e-4, where the quotients lose their digits.
  const double a = angle < 1e-4 ? 1.0 - angle * angle / 6.0 : std::sin(angle) / angle;
  const double half = angle / 2.0;
  const double s = angle < 1e-4 ? 1.0 - half * half / 6.0 : std::sin(half) / half;
  const double b = 0.5 * s * s;
  const Mat3 k = {{{{0, -v.z, v.y}, {v.z, 0, -v.x}, {-v.y, v.x, 0}}}};
  const Mat3 k2 = k * k;
  Mat3 r = Mat3::identity();
  for (int i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      r[i][j] += a * k[i][j] + b * k2[i][j];
    }
  }
  return r;
}

Vec3 vector_from_rotation(const Mat3& r) {
  const Quaternion q = quaternion_from_rotation(r);
  const Vec3 v{q.x, q.y, q.z};
  const double sine = v.norm();
  if (sine < 1e-12) {
    return 2.0 * v;
  }
  return v * (2.0 * std::atan2(sine, q.w) / sine);
}

Mat3 rotation_from_quaternion(Quaternion q) {
  const double n = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  const double x = q.x / n;
  const double y = q.y / n;
  const double z = q.z / n;
  const double w = q.w / n;
  return {{{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
            {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
            {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}}};
}

Quaternion quaternion_from_rotation(const Mat3& r) {
  // Shepperd's method: divide by the largest of the four, never by something near zero.
  const double t = r[0][0] + r[1][1] + r[2][2];
  Quaternion q;
  if (t >= r[0][0] && t >= r[1][1] && t >= r[2][2]) {
    const double s = 2.0 * std::sqrt(1.0 + t);
    q = {(r[2][1] - r[1][2]) / s, (r[0][2] - r[2][0]) / s, (r[1][0] - r[0][1]) / s, s / 4};
  } else if (r[0][0] >= r[1][1] && r[0][0] >= r[2][2]) {
    const double s = 2.0 * std::sqrt(1.0 + r[0][0] - r[1][1] - r[2][2]);
    q = {s / 4, (r[0][1] + r[1][0]) / s, (r[0][2] + r[2][0]) / s, (r[2][1] - r[1][2]) / s};
  } else if (r[1][1] >= r[2][2]) {
    const double s = 2.0 * std::sqrt(1.0 - r[0][0] + r[1][1] - r[2][2]);
    q = {(r[0][1] + r[1][0]) / s, s / 4, (r[1][2] + r[2][1]) / s, (r[0][2] - r[2][0]) / s};
  } else {
    const double s = 2.0 * std::sqrt(1.0 - r[0][0] - r[1][1] + r[2][2]);
    q = {(r[0][2] + r[2][0]) / s, (r[1][2] + r[2][1]) / s, s / 4, (r[1][0] - r[0][1]) / s};
  }
  return q.w < 0 ? Quaternion{-q.x, -q.y, -q.z, -q.w} : q;
}

Mat3 orthonormalized(const Mat3& a) {
  const Vec3 x = a.row(0).normalized();
  const Vec3 y = (a.row(1) - x.dot(a.row(1)) * x).normalized();
  return Mat3::from_columns(x, y, x.cross(y)).transposed();
}

double orthonormality_error(const Mat3& matrix) {
  const Mat3 gram = matrix * matrix.transposed();
  double worst = 0.0;
  for (int r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double error = std::abs(gram[r][c] - (static_cast<std::size_t>(r) == c ? 1.0 : 0.0));
      if (std::isnan(error)) {
        return error;
      }
      worst = std::max(worst, error);
    }
  }
  return worst;
}

double rotation_angle_rad(const Mat3& a, const Mat3& b) {
  return vector_from_rotation(a.transposed() * b).norm();
}

}  // namespace orthonav
