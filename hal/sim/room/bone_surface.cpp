#include "hal/sim/room/bone_surface.h"

#include <cmath>
#include <limits>

namespace orthonav::sim {
namespace {

struct Triangle {
  Vec3 a;
  Vec3 b;
  Vec3 c;
  [[nodiscard]] Vec3 normal() const { return (b - a).cross(c - a); }
};

Triangle corners(const RoomLevel& level, std::size_t i) {
  const auto& t = level.triangles[i];
  return {level.vertices_m[t[0]], level.vertices_m[t[1]], level.vertices_m[t[2]]};
}

/// Ericson, Real-Time Collision Detection, section 5.1.5.
Vec3 closest_on(const Triangle& t, Vec3 p) {
  const Vec3 ab = t.b - t.a;
  const Vec3 ac = t.c - t.a;
  const double d1 = ab.dot(p - t.a);
  const double d2 = ac.dot(p - t.a);
  if (d1 <= 0.0 && d2 <= 0.0) {
    return t.a;
  }
  const double d3 = ab.dot(p - t.b);
  const double d4 = ac.dot(p - t.b);
  if (d3 >= 0.0 && d4 <= d3) {
    return t.b;
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    return t.a + (d1 / (d1 - d3)) * ab;
  }
  const double d5 = ab.dot(p - t.c);
  const double d6 = ac.dot(p - t.c);
  if (d6 >= 0.0 && d5 <= d6) {
    return t.c;
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    return t.a + (d2 / (d2 - d6)) * ac;
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    return t.b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (t.c - t.b);
  }
  const double scale = 1.0 / (va + vb + vc);
  return t.a + (vb * scale) * ab + (vc * scale) * ac;
}

/// Distance along the ray to the outer side of a triangle (Möller and Trumbore 1997).
std::optional<double> distance_to(const Triangle& t, Vec3 origin, Vec3 direction) {
  const Vec3 ab = t.b - t.a;
  const Vec3 ac = t.c - t.a;
  const Vec3 p = direction.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant <= 0.0) {
    return std::nullopt;
  }
  const Vec3 s = origin - t.a;
  const double u = s.dot(p);
  if (u < 0.0 || u > determinant) {
    return std::nullopt;
  }
  const Vec3 q = s.cross(ab);
  const double v = direction.dot(q);
  if (v < 0.0 || u + v > determinant) {
    return std::nullopt;
  }
  return ac.dot(q) / determinant;
}

Vec3 unit_or_up(Vec3 v) { return v.squared_norm() > 0.0 ? v.normalized() : Vec3{0, 1, 0}; }

}  // namespace

BoneSpot BoneSurface::closest(Vec3 point) const {
  BoneSpot best{point, {0, 1, 0}};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < level_->triangles.size(); ++i) {
    const Triangle triangle = corners(*level_, i);
    if (triangle.normal().squared_norm() == 0.0) {
      continue;
    }
    const Vec3 near = closest_on(triangle, point);
    const double distance = (near - point).squared_norm();
    if (!(distance < least)) {
      continue;
    }
    least = distance;
    best = {near, unit_or_up(triangle.normal())};
  }
  return best;
}

std::optional<BoneSpot> BoneSurface::first_hit(Vec3 origin, Vec3 direction, double reach_m) const {
  std::optional<BoneSpot> hit;
  double least = reach_m;
  for (std::size_t i = 0; i < level_->triangles.size(); ++i) {
    const Triangle triangle = corners(*level_, i);
    const auto distance = distance_to(triangle, origin, direction);
    if (!distance || *distance < 0.0 || *distance > least) {
      continue;
    }
    least = *distance;
    hit = BoneSpot{origin + least * direction, unit_or_up(triangle.normal())};
  }
  return hit;
}

}  // namespace orthonav::sim
