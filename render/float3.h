#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/scene.h"

namespace orthonav::render {

using glm::cross;
using glm::dot;
using glm::length;
[[nodiscard]] inline bool is_finite(Float3 a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// The unit vector along `a`, or `fallback` where `a` has no direction.
[[nodiscard]] inline Float3 unit_or(Float3 a, Float3 fallback) {
  const float norm = length(a);
  return norm > 1e-12f && std::isfinite(norm) ? (1.0f / norm) * a : fallback;
}

/// The squared distance of a point from the segment between `a` and `b`.
[[nodiscard]] inline float squared_distance_to_segment(Float3 p, Float3 a, Float3 b) {
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
