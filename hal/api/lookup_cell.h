#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "base/vec.h"

namespace orthonav {

// Cells of a camera's look-up table (hal/api/camera_model.h): directions at pixel centres, and
// between them.

/// The entry of a pixel without a direction.
inline constexpr Vec2 kNoDirection{std::numeric_limits<double>::quiet_NaN(),
                                   std::numeric_limits<double>::quiet_NaN()};

/// A pixel without a direction.
[[nodiscard]] inline bool is_nan(Vec2 v) { return std::isnan(v.x) || std::isnan(v.y); }

/// The table between four neighbouring pixel centres: value and derivative at fractional positions.
struct LookupCell {
  Vec2 a;  ///< top left
  Vec2 b;  ///< top right
  Vec2 c;  ///< bottom left
  Vec2 d;  ///< bottom right

  [[nodiscard]] bool valid() const { return !is_nan(a) && !is_nan(b) && !is_nan(c) && !is_nan(d); }
  [[nodiscard]] Vec2 value(double s, double t) const {
    const Vec2 top = a + s * (b - a);
    const Vec2 bottom = c + s * (d - c);
    return top + t * (bottom - top);
  }
  [[nodiscard]] Vec2 along_x(double t) const { return (1.0 - t) * (b - a) + t * (d - c); }
  [[nodiscard]] Vec2 along_y(double s) const { return (1.0 - s) * (c - a) + s * (d - b); }
};

[[nodiscard]] inline LookupCell cell_at(std::span<const Vec2> lookup, int width_px, int column,
                                        int row) {
  const auto i = static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px) +
                 static_cast<std::size_t>(column);
  const auto below = i + static_cast<std::size_t>(width_px);
  return {lookup[i], lookup[i + 1], lookup[below], lookup[below + 1]};
}

}  // namespace orthonav
