#include "nav/evaluation/fixed_point.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <vector>

#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

// Stretches begin and end at boundaries of blocks this long.
constexpr double kBlock_s = 0.25;
// A stretch that has not fitted for this many more blocks won't fit again.
constexpr int kFarFromBest = 8;
// Tips that fit a fixed point worse than this did not rest in a dimple.
constexpr double kMaxTurningRmse_m = 0.005;
// A resting point farther than this from the tip in the tool file is not this pointer's tip.
constexpr double kMaxOffset_m = 0.03;

/// Sums over poses from which the fit of any stretch follows. With q the tip from the tool file and
/// d its offset, the tips R d + q should all be the same point p.
struct Sums {
  double n = 0.0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();       ///< R
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();            ///< q
  Eigen::Vector3d tip_in_marker = Eigen::Vector3d::Zero();  ///< Rᵀq
  double squares = 0.0;                                     ///< |q|²

  void add(const Eigen::Matrix3d& R, const Eigen::Vector3d& q) {
    n += 1.0;
    rotation += R;
    tip += q;
    tip_in_marker += R.transpose() * q;
    squares += q.squaredNorm();
  }
  friend Sums operator-(Sums a, const Sums& b) {
    a.n -= b.n;
    a.rotation -= b.rotation;
    a.tip -= b.tip;
    a.tip_in_marker -= b.tip_in_marker;
    a.squares -= b.squares;
    return a;
  }
};

struct Fit {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  double spread_rad = 0.0;
  double rmse_m = 0.0;
};

Fit fit_of(const Sums& sums) {
  Fit fit;
  const Eigen::Matrix3d normal =
      sums.n * Eigen::Matrix3d::Identity() - sums.rotation.transpose() * sums.rotation / sums.n;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(normal);
  fit.spread_rad = std::sqrt(std::max(0.0, solver.eigenvalues()(0)) / sums.n);
  // Without rotation the offset is undetermined; the tip from the tool file is then as good as any.
  if (fit.spread_rad >= kLeastTurningSpread_rad) {
    fit.offset =
        normal.ldlt().solve(sums.rotation.transpose() * sums.tip / sums.n - sums.tip_in_marker);
  }
  const Eigen::Vector3d p = (sums.tip + sums.rotation * fit.offset) / sums.n;
  const double squares = sums.squares + sums.n * fit.offset.squaredNorm() +
                         2.0 * fit.offset.dot(sums.tip_in_marker) - sums.n * p.squaredNorm();
  fit.rmse_m = std::sqrt(std::max(0.0, squares) / sums.n);
  return fit;
}

/// Sums over all poses before each block, and where each block begins.
struct PoseBlocks {
  std::vector<Sums> before;
  std::vector<std::size_t> first;
};

PoseBlocks blocks_of(std::span<const TrackedPose> poses, Point<Marker> tip) {
  PoseBlocks blocks;
  // Relative to the first tip, since otherwise the squares lose significant digits.
  const Vec3 origin_m = (poses[0].value * tip).v;
  Sums sums;
  double begins_s = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double time_s = seconds(poses[i].time - poses[0].time);
    if (i == 0 || time_s >= begins_s + kBlock_s) {
      blocks.before.push_back(sums);
      blocks.first.push_back(i);
      begins_s = time_s;
    }
    sums.add(matrix_as<Eigen::Matrix3d>(poses[i].value.rotation()),
             vector_as<Eigen::Vector3d>((poses[i].value * tip).v - origin_m));
  }
  blocks.before.push_back(sums);
  blocks.first.push_back(poses.size());
  return blocks;
}

}  // namespace

std::optional<FixedPoint> longest_fixed_point(std::span<const TrackedPose> world_from_marker,
                                              Point<Marker> tip) {
  if (world_from_marker.empty()) {
    return std::nullopt;
  }
  const PoseBlocks blocks = blocks_of(world_from_marker, tip);
  std::optional<FixedPoint> best;
  double best_score = 0.0;
  for (std::size_t from = 0; from + 1 < blocks.first.size(); ++from) {
    int unfit = 0;
    for (std::size_t to = from + 1; to < blocks.first.size() && unfit < kFarFromBest; ++to) {
      const std::size_t first = blocks.first[from];
      const std::size_t end = blocks.first[to];
      const Fit fit = fit_of(blocks.before[to] - blocks.before[from]);
      if (fit.rmse_m > kMaxTurningRmse_m || fit.offset.norm() > kMaxOffset_m) {
        // While the tool has turned too little to determine the offset, a wrong tip looks like a
        // motion, but no larger than its offset can cause.
        if (fit.spread_rad >= kLeastTurningSpread_rad ||
            fit.rmse_m > 2.0 * kMaxOffset_m + kMaxTurningRmse_m) {
          ++unfit;
        }
        continue;
      }
      unfit = 0;
      const double duration_s =
          seconds(world_from_marker[end - 1].time - world_from_marker[first].time);
      if (duration_s < kLeastTurning_s || fit.spread_rad < kLeastTurningSpread_rad) {
        continue;
      }
      const double ratio = fit.rmse_m / kMaxTurningRmse_m;
      const double score = duration_s * (1.0 - ratio * ratio);
      if (score <= best_score) {
        continue;
      }
      best_score = score;
      best = FixedPoint{first, end, vec_of(fit.offset), fit.rmse_m};
    }
  }
  return best;
}

}  // namespace orthonav::nav
