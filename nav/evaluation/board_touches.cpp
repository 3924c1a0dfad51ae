#include "nav/evaluation/board_touches.h"

#include <numeric>
#include <optional>
#include <string>

#include "nav/geometry/absolute_orientation.h"

namespace orthonav::nav {
namespace {

/// The next choice of the same number of the first `count` indices, ascending; false after the
/// last.
bool next_choice(std::vector<std::size_t>& chosen, std::size_t count) {
  const std::size_t n = chosen.size();
  for (std::size_t i = n; i-- > 0;) {
    if (chosen[i] == count - n + i) {
      continue;
    }
    ++chosen[i];
    for (std::size_t k = i + 1; k < n; ++k) {
      chosen[k] = chosen[k - 1] + 1;
    }
    return true;
  }
  return false;
}

std::vector<Vec3> picked(std::span<const Vec3> from, const std::vector<std::size_t>& indices) {
  std::vector<Vec3> out;
  for (const std::size_t i : indices) {
    out.push_back(from[i]);
  }
  return out;
}

}  // namespace

Result<BoardTouches> board_touches(std::span<const Vec3> rests_m, std::span<const Vec3> points_m,
                                   std::size_t max_stray) {
  const std::size_t wanted = points_m.size();
  if (rests_m.size() < wanted || rests_m.size() > wanted + max_stray) {
    return Error{"board: the tip rested at " + std::to_string(rests_m.size()) +
                 " places away from the dimple, must be " + std::to_string(wanted) + " to " +
                 std::to_string(wanted + max_stray) + " for its " + std::to_string(wanted) +
                 " points, each touched once"};
  }
  std::vector<std::size_t> chosen(wanted);
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  BoardTouches best;
  std::optional<RigidFit> best_fit;
  std::string why;
  do {
    const auto fit = absolute_orientation(picked(rests_m, chosen), points_m);
    if (!fit) {
      why = fit.error().message;
      continue;
    }
    if (best_fit && fit->rmse_m >= best_fit->rmse_m) {
      continue;
    }
    best_fit = *fit;
    best.rest_of_point = chosen;
  } while (next_choice(chosen, rests_m.size()));
  if (!best_fit) {
    return Error{"board: " + why};
  }
  best.fit_rmse_m = best_fit->rmse_m;
  for (std::size_t i = 0; i < wanted; ++i) {
    best.residual_m.push_back(best_fit->rotation * rests_m[best.rest_of_point[i]] +
                              best_fit->translation_m - points_m[i]);
  }
  return best;
}

}  // namespace orthonav::nav
