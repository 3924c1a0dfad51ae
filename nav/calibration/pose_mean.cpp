#include "nav/calibration/pose_mean.h"

#include <algorithm>
#include <limits>

#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

using FromTag = Transform<Tag, Tag>;

constexpr double kRadianM = 0.05;
// At distances below this, weights no longer grow.
constexpr double kNearM = 1e-6;
constexpr int kSteps = 50;
constexpr double kConvergedM = 1e-9;
// The start is the best of this many candidates: enough when more than half of them are good.
constexpr std::size_t kMaxCandidates = 40;

struct Difference {
  Vec3 translation_m;
  Vec3 rotation_rad;
  [[nodiscard]] double length_m() const {
    return std::sqrt(translation_m.squared_norm() +
                     kRadianM * kRadianM * rotation_rad.squared_norm());
  }
};

Difference difference(const FromTag& from, const FromTag& to) {
  return {to.translation() - from.translation(),
          vector_from_rotation(to.rotation() * from.rotation().transposed())};
}

double total_m(const FromTag& centre, std::span<const FromTag> poses) {
  double sum = 0.0;
  for (const FromTag& pose : poses) {
    sum += difference(centre, pose).length_m();
  }
  return sum;
}

/// The pose nearest to all the others.
FromTag middle_one(std::span<const FromTag> poses) {
  const std::size_t stride = (poses.size() + kMaxCandidates - 1) / kMaxCandidates;
  FromTag best;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < poses.size(); i += stride) {
    const double sum_m = total_m(poses[i], poses);
    if (!(sum_m < least_m)) {
      continue;
    }
    least_m = sum_m;
    best = poses[i];
  }
  return best;
}

}  // namespace

FromTag median_pose(std::span<const FromTag> poses) {
  FromTag centre = middle_one(poses);
  for (int step = 0; step < kSteps; ++step) {
    Difference mean;
    double total = 0.0;
    for (const FromTag& pose : poses) {
      const Difference off = difference(centre, pose);
      const double weight = 1.0 / std::max(off.length_m(), kNearM);
      mean.translation_m += weight * off.translation_m;
      mean.rotation_rad += weight * off.rotation_rad;
      total += weight;
    }
    mean = {mean.translation_m / total, mean.rotation_rad / total};
    centre = displaced(centre, mean.translation_m, mean.rotation_rad);
    if (mean.length_m() < kConvergedM) {
      break;
    }
  }
  return centre;
}

}  // namespace orthonav::nav
