#pragma once

#include <algorithm>
#include <cmath>

#include "render/scene.h"

namespace orthonav::render {

[[nodiscard]] constexpr Float3 operator+(Float3 a, Float3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] constexpr Float3 operator-(Float3 a, Float3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] constexpr Float3 operator*(float s, Float3 a) { return {s * a.x, s * a.y, s * a.z}; }
[[nodiscard]] constexpr float dot(Float3 a, Float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] constexpr Float3 cross(Float3 a, Float3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline float length(Float3 a) { return std::sqrt(dot(a, a)); }
[[nodiscard]] inline bool is_finite(Float3 a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// The unit vector along `a`, or `fallback` where `a` has no direction.
[[nodiscard]] inline Float3 unit_or(Float3 a, Float3 fallback) {
  const float norm = length(a);
  return norm > 1e-12f && std::isfinite(norm) ? (1.0f / norm) * a : fallback;
}

/// The squared distance of a point from the segment between `a` and `b`.
[[nodiscard]] constexpr float squared_distance_to_segment(Float3 p, Float3 a, Float3 b) {
  const Float3 along = b - a;
  const float squared_length = dot(along, along);
  const float part =
      squared_length > 0 ? std::clamp(dot(p - a, along) / squared_length, 0.0f, 1.0f) : 0.0f;
  const Float3 off = p - a - part * along;
  return dot(off, off);
}

/// A unit vector perpendicular to the unit vector `a`, always the same for the same `a`.
[[nodiscard]] inline Float3 any_perpendicular(Float3 a) {
  const Float3 helper = std::abs(a.x) < 0.7f ? Float3{1, 0, 0} : Float3{0, 1, 0};
  return unit_or(cross(a, helper), {0, 0, 1});
}

}  // namespace orthonav::render
