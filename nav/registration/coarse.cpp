#include "nav/registration/coarse.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nav/geometry/absolute_orientation.h"
#include "nav/published/icp.h"

namespace orthonav::nav {
namespace {

using Pose = Transform<World, Vertebra>;

constexpr double kSamePlace_m = 0.003;
constexpr double kSameRotation_rad = 0.1;
constexpr double kTranslation_m = 0.009;
constexpr double kRotation_rad = 0.35;
constexpr int kShakes = 8;
/// The proper pairings of three axes and their signs: with duplicates dropped, all of them can be
/// perturbed.
constexpr std::size_t kPairings = 24;
/// Enough points to tell a good pose from a bad one, few enough to try hundreds.
constexpr std::size_t kThinned = 80;
/// A perturbed pose is better only when its RMSE falls by more than ICP's own tolerance.
constexpr double kBetter_m = 1e-5;
constexpr IcpOptions kFirstLook{30, 1e-5};
constexpr IcpOptions kShakeLook{25, 2e-5};

std::vector<Point<World>> thinned(std::span<const Point<World>> points, std::size_t count) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / count);
  std::vector<Point<World>> few;
  for (std::size_t i = 0; i < points.size(); i += step) {
    few.push_back(points[i]);
  }
  return few;
}

/// The 24 ways to lay one right-handed set of axes onto another: the order and direction of the
/// digitized extreme points for the model's.
std::vector<std::array<Vec3, 6>> proper_pairings(const std::array<Vec3, 6>& extremes) {
  constexpr std::array<std::array<std::size_t, 3>, 6> kOrders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};  // 3 even, 3 odd
  std::vector<std::array<Vec3, 6>> pairings;
  for (std::size_t order = 0; order < kOrders.size(); ++order) {
    for (unsigned flips = 0; flips < 8; ++flips) {
      const bool odd_flips = ((flips ^ (flips >> 1) ^ (flips >> 2)) & 1U) != 0;
      if ((order >= 3) != odd_flips) {
        continue;  // would mirror
      }
      std::array<Vec3, 6> paired;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t axis = kOrders[order][k];
        const std::size_t flip = (flips >> k) & 1U;
        paired[2 * k] = extremes[2 * axis + flip];
        paired[2 * k + 1] = extremes[2 * axis + 1 - flip];
      }
      pairings.push_back(paired);
    }
  }
  return pairings;
}

void sort_by_fit(std::vector<CoarsePose>& poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const CoarsePose& a, const CoarsePose& b) { return a.rmse_m < b.rmse_m; });
}

class Search {
 public:
  Search(const VertebraModel& model, std::span<const Point<World>> points)
      : model_(model), few_(thinned(points, kThinned)) {}

  [[nodiscard]] std::vector<CoarsePose> starts(std::span<const Point<World>> points) const {
    std::vector<Vec3> digitized(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      digitized[i] = points[i].v;
    }
    const auto extremes = extreme_points(digitized, principal_axes(digitized));
    std::vector<CoarsePose> found;
    for (const auto& paired : proper_pairings(extremes)) {
      if (const auto fit = absolute_orientation(model_.reachable_extremes(), paired)) {
        if (const auto pose = look({fit->rotation, fit->translation_m}, kFirstLook)) {
          found.push_back(*pose);
        }
      }
    }
    return found;
  }

  /// Escapes local minima: takes the best of twelve perturbed and refined poses, repeatedly, as
  /// long as it improves.
  [[nodiscard]] CoarsePose shaken(CoarsePose pose) const {
    for (int i = 0; i < kShakes; ++i) {
      CoarsePose best = pose;
      for (const Pose& start : neighbours(pose.world_from_vertebra)) {
        if (const auto found = look(start, kShakeLook)) {
          if (found->rmse_m < best.rmse_m - kBetter_m) {
            best = *found;
          }
        }
      }
      if (best.rmse_m == pose.rmse_m) {
        break;
      }
      pose = best;
    }
    return pose;
  }

  /// Sorted, without poses close to a better one.
  [[nodiscard]] std::vector<CoarsePose> distinct(std::vector<CoarsePose> poses,
                                                 std::size_t most) const {
    sort_by_fit(poses);
    std::vector<CoarsePose> kept;
    for (const CoarsePose& pose : poses) {
      if (kept.size() < most && std::all_of(kept.begin(), kept.end(), [&](const CoarsePose& k) {
            return differ_clearly(model_, k.world_from_vertebra, pose.world_from_vertebra);
          })) {
        kept.push_back(pose);
      }
    }
    return kept;
  }

 private:
  /// ICP on the approximate closest points of the grid.
  [[nodiscard]] std::optional<CoarsePose> look(const Pose& start, const IcpOptions& options) const {
    std::vector<Vec3> digitized(few_.size());
    for (std::size_t i = 0; i < few_.size(); ++i) {
      digitized[i] = few_[i].v;
    }
    std::vector<Vec3> closest(few_.size());
    CoarsePose result{start, match(start, closest)};
    for (int i = 0; i < options.max_iterations; ++i) {
      const auto fit = absolute_orientation(closest, digitized);
      if (!fit) {
        return std::nullopt;
      }
      const Pose pose{fit->rotation, fit->translation_m};
      const double rmse_m = match(pose, closest);
      const double gained_m = result.rmse_m - rmse_m;
      if (gained_m > 0.0) {
        result = {pose, rmse_m};
      }
      if (!(gained_m > options.converged_m)) {
        break;
      }
    }
    return result;
  }

  double match(const Pose& pose, std::vector<Vec3>& closest) const {
    const Transform<Vertebra, World> vertebra_from_world = pose.inverse();
    double sum_m2 = 0.0;
    for (std::size_t i = 0; i < few_.size(); ++i) {
      const Vec3 query_m = (vertebra_from_world * few_[i]).v;
      closest[i] = model_.reachable_grid().nearest(query_m);
      sum_m2 += (closest[i] - query_m).squared_norm();
    }
    return std::sqrt(sum_m2 / static_cast<double>(few_.size()));
  }

  [[nodiscard]] std::vector<Pose> neighbours(const Pose& pose) const {
    const Vec3 centre = (pose * Point<Vertebra>{model_.reachable_axes().centre_m}).v;
    std::vector<Pose> poses;
    for (const Vec3& axis_in_vertebra : model_.reachable_axes().axes) {
      for (const double sign : {1.0, -1.0}) {
        const Vec3 axis = sign * (pose.rotation() * axis_in_vertebra);
        poses.emplace_back(pose.rotation(), pose.translation() + kTranslation_m * axis);
        const Mat3 rotation_step = rotation_from_vector(kRotation_rad * axis);
        poses.emplace_back(rotation_step * pose.rotation(),
                           rotation_step * (pose.translation() - centre) + centre);
      }
    }
    return poses;
  }

  const VertebraModel& model_;
  std::vector<Point<World>> few_;
};

}  // namespace

bool differ_clearly(const VertebraModel& model, const Pose& a, const Pose& b) {
  const Point<Vertebra> centre{model.reachable_axes().centre_m};
  return (a * centre - b * centre).norm() > kSamePlace_m ||
         rotation_angle_rad(a.rotation(), b.rotation()) > kSameRotation_rad;
}

std::vector<CoarsePose> coarse_poses(const VertebraModel& model,
                                     std::span<const Point<World>> points_in_world) {
  const Search search(model, points_in_world);
  std::vector<CoarsePose> poses = search.distinct(search.starts(points_in_world), kPairings);
  for (CoarsePose& pose : poses) {
    pose = search.shaken(pose);
  }
  return search.distinct(std::move(poses), 2);
}

}  // namespace orthonav::nav
