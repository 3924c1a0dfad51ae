#pragma once

#include <span>
#include <vector>

#include "base/result.h"
#include "base/vec.h"

namespace orthonav::nav {

/// Which rests touched which points of a board, and how well they fit.
struct BoardTouches {
  std::vector<std::size_t> rest_of_point;  ///< ascending
  std::vector<Vec3> residual_m;            ///< touched minus known, along the board's axes
  double fit_rmse_m = 0.0;
};

/// The points must have been touched in their order; surplus rests (such as a tool laid aside) are
/// left out such that the others fit best (rigid, Horn 1987). Refuses fewer rests than points, a
/// surplus above `max_stray`, and points or rests that all lie on a line.
Result<BoardTouches> board_touches(std::span<const Vec3> rests_m, std::span<const Vec3> points_m,
                                   std::size_t max_stray);

}  // namespace orthonav::nav
