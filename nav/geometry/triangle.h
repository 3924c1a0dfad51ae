#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "base/vec.h"

namespace orthonav::nav {

using Triangle = std::array<Vec3, 3>;

/// The point of a segment nearest to p; a segment of length zero is its first end.
inline Vec3 nearest_on_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const double length2 = ab.squared_norm();
  if (!(length2 > 0.0)) {
    return a;
  }
  const double t = (p - a).dot(ab) / length2;
  return t <= 0.0 ? a : (t >= 1.0 ? b : a + t * ab);
}

/// The point of a triangle nearest to p (Ericson 2005, "Real-Time Collision Detection", 5.1.5).
/// A triangle without area is its longest edge.
inline Vec3 nearest_on_triangle(Vec3 p, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) {
    return a;
  }
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) {
    return b;
  }
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) {
    return c;
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    return nearest_on_segment(p, a, b);
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    return nearest_on_segment(p, a, c);
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
    return nearest_on_segment(p, b, c);
  }
  const double sum = va + vb + vc;
  if (!(sum > 0.0)) {
    return nearest_on_segment(p, a, ab.squared_norm() > ac.squared_norm() ? b : c);
  }
  return a + (vb / sum) * ab + (vc / sum) * ac;
}

/// Where a ray meets a triangle, as a multiple of `direction` >= 0 (Möller & Trumbore 1997). The
/// edges are widened a little, so that no ray slips between neighbours.
inline std::optional<double> ray_meets_triangle(Vec3 origin, Vec3 direction,
                                                const Triangle& triangle) {
  constexpr double kWider = 1e-10;
  const Vec3 e1 = triangle[1] - triangle[0];
  const Vec3 e2 = triangle[2] - triangle[0];
  const Vec3 h = direction.cross(e2);
  const double det = e1.dot(h);
  if (!(std::abs(det) > 0.0)) {
    return std::nullopt;
  }
  const Vec3 s = origin - triangle[0];
  const double u = s.dot(h) / det;
  if (!(u >= -kWider && u <= 1.0 + kWider)) {
    return std::nullopt;
  }
  const Vec3 q = s.cross(e1);
  const double v = direction.dot(q) / det;
  if (!(v >= -kWider && u + v <= 1.0 + kWider)) {
    return std::nullopt;
  }
  const double t = e2.dot(q) / det;
  if (!(t >= 0.0)) {
    return std::nullopt;
  }
  return t;
}

/// Unit normal by the right-hand rule; zero for a triangle without area.
inline Vec3 triangle_normal(const Triangle& t) {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double length = n.norm();
  return length > 0.0 ? n / length : Vec3{};
}

inline double triangle_area_m2(const Triangle& t) {
  return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
}

}  // namespace orthonav::nav
