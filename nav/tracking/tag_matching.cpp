#include "nav/tracking/tag_matching.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orthonav::nav {
namespace {

struct Wanted {
  std::string_view family;
  int id = 0;
  [[nodiscard]] bool is(const MarkerCorners& seen) const {
    return seen.family == family && seen.id == id;
  }
};

bool is_consistent(const TagPair& pair, double size_m, const TagGeometry& geometry,
                   const MatchLimits& limits) {
  const std::optional<TagPose> pose = geometry.pose(pair, size_m);
  return pose && pose->gap_px <= limits.gap_px &&
         std::abs(pose->size_ratio - 1.0) <= limits.size_fraction &&
         pose->fit_rmse_m <= limits.size_fraction * size_m;
}

double distance_px(const TagCorners& a, const TagCorners& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += (a[i] - b[i]).norm();
  }
  return sum;
}

// Smaller is better.
double cost(const MarkerCorners& left, const MarkerCorners& right,
            const std::optional<TagPair>& expected) {
  if (!expected) {
    return -std::min(left.decision_margin, right.decision_margin);
  }
  return distance_px(left.corners_px, expected->left_px) +
         distance_px(right.corners_px, expected->right_px);
}

const MarkerCorners* best_decoded(std::span<const MarkerCorners> found, const Wanted& wanted) {
  const MarkerCorners* best = nullptr;
  for (const MarkerCorners& seen : found) {
    if (wanted.is(seen) && (!best || seen.decision_margin > best->decision_margin)) {
      best = &seen;
    }
  }
  return best;
}

}  // namespace

TagMatch matched(std::span<const MarkerCorners> left, std::span<const MarkerCorners> right,
                 std::string_view family, int id, double size_m, const TagGeometry& geometry,
                 const std::optional<TagPair>& expected, const MatchLimits& limits) {
  const Wanted wanted{family, id};
  const TagMatch alone{best_decoded(left, wanted), best_decoded(right, wanted)};
  if (!alone.both()) {
    return alone;
  }
  TagMatch match;
  double least = std::numeric_limits<double>::infinity();
  for (const MarkerCorners& a : left) {
    if (!wanted.is(a)) {
      continue;
    }
    for (const MarkerCorners& b : right) {
      if (!wanted.is(b)) {
        continue;
      }
      const double now = cost(a, b, expected);
      if (now >= least || !is_consistent({a.corners_px, b.corners_px}, size_m, geometry, limits)) {
        continue;
      }
      least = now;
      match = {&a, &b};
    }
  }
  return match;
}

std::optional<double> size_ratio(std::span<const MarkerCorners> left,
                                 std::span<const MarkerCorners> right, std::string_view family,
                                 int id, double size_m, const TagGeometry& geometry,
                                 const MatchLimits& limits) {
  const MarkerCorners* a = best_decoded(left, {family, id});
  const MarkerCorners* b = best_decoded(right, {family, id});
  if (!a || !b) {
    return std::nullopt;
  }
  const TagPair pair{a->corners_px, b->corners_px};
  const std::optional<TagPose> pose = geometry.pose(pair, size_m);
  if (!pose || !is_consistent(pair, pose->size_ratio * size_m, geometry, limits)) {
    return std::nullopt;
  }
  return pose->size_ratio;
}

}  // namespace orthonav::nav
