#include "nav/registration/pose_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "nav/registration/spread_points.h"
#include "nav/registration/surface_step.h"

namespace orthonav::nav {
namespace {

constexpr double kFieldCell_m = 0.002;
constexpr double kFieldMargin_m = 0.014;

constexpr double kSearchCell_m = 0.002;
/// Points on the back of a vertebra lie within this distance of their centre; farther ones are
/// outliers.
constexpr double kReach_m = 0.075;
/// Costs of single points are truncated here: an outlier costs no more for being farther off.
constexpr double kFarthest_m = 0.010;
constexpr double kInsideFactor = 1.5;
constexpr double kCostPerM = 250.0 / (kInsideFactor * kFarthest_m);

constexpr int kRotations = 1000;
constexpr int kPlaceStep = SearchField::Cells::kApart;
/// Centres of strokes lie inside the box of the reachable surface, at least this far from its rim.
constexpr double kInset_m = 0.006;
constexpr std::size_t kPointsAdded = 32;
constexpr std::size_t kPointsFirst = 48;
constexpr std::size_t kPointsThen = 120;
constexpr std::size_t kPointsLast = 300;
constexpr std::size_t kKeptFirst = 500;
constexpr std::size_t kKeptThen = 100;
constexpr std::size_t kKeptLast = 20;

/// Rotations spread evenly over all orientations.
std::vector<Mat3> all_rotations() {
  constexpr double kPsi = 1.533751168755204288118041;
  std::vector<Mat3> rotations;
  rotations.reserve(kRotations);
  for (int i = 0; i < kRotations; ++i) {
    const double s = i + 0.5;
    const double r = std::sqrt(s / kRotations);
    const double q = std::sqrt(1.0 - s / kRotations);
    const double alpha = 2.0 * std::numbers::pi * s / std::numbers::sqrt2;
    const double beta = 2.0 * std::numbers::pi * s / kPsi;
    rotations.push_back(rotation_from_quaternion(
        {r * std::sin(alpha), r * std::cos(alpha), q * std::sin(beta), q * std::cos(beta)}));
  }
  return rotations;
}

struct Scored {
  CentredPose pose;
  double cost = 0.0;
};

bool is_better(const Scored& a, const Scored& b) { return a.cost < b.cost; }

/// Adds up the coarse costs of every place for one rotation.
class PlaceScan {
 public:
  PlaceScan(const SearchField& vertebra, std::span<const Vec3> centred_m)
      : cells_(vertebra.cells()), points_m_(centred_m), offsets_(centred_m.size()) {
    const Vec3 inset{kInset_m, kInset_m, kInset_m};
    low_m_ = vertebra.reachable_bounds().low + inset;
    const Vec3 extent = vertebra.reachable_bounds().high - inset - low_m_;
    for (std::size_t k = 0; k < 3; ++k) {
      steps_[k] = std::max(
          1, 1 + static_cast<int>(extent[static_cast<int>(k)] / (kPlaceStep * cells_.cell_m)));
    }
  }

  /// Finds the two best places that are not neighbours.
  void scan(const Mat3& rotation, std::vector<Scored>& out) {
    for (std::size_t i = 0; i < points_m_.size(); ++i) {
      const Vec3 p = (rotation * points_m_[i] + low_m_ - cells_.low_m) / cells_.cell_m;
      offsets_[i] =
          cells_.index(static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z));
    }
    std::array<Place, 2> best;
    for (int z = 0; z < steps_[2]; ++z) {
      for (int y = 0; y < steps_[1]; ++y) {
        for (int x = 0; x < steps_[0]; x += kRun) {
          const std::array<std::uint16_t, kRun> costs = costs_from(x, y, z);
          for (int i = 0; i < std::min(kRun, steps_[0] - x); ++i) {
            take({costs[static_cast<std::size_t>(i)], {x + i, y, z}}, best);
          }
        }
      }
    }
    for (const Place& place : best) {
      if (place.cost == kNone) {
        continue;
      }
      const Vec3 at_m =
          low_m_ + kPlaceStep * cells_.cell_m *
                       Vec3{static_cast<double>(place.at[0]), static_cast<double>(place.at[1]),
                            static_cast<double>(place.at[2])};
      out.push_back({{rotation, at_m}, static_cast<double>(place.cost)});
    }
  }

 private:
  static constexpr int kRun = SearchField::Cells::kRun;
  static_assert(kPointsAdded * std::numeric_limits<std::uint8_t>::max() <=
                std::numeric_limits<std::uint16_t>::max());
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  struct Place {
    std::uint32_t cost = kNone;
    std::array<int, 3> at{};
    [[nodiscard]] bool is_next_to(const Place& other) const {
      for (std::size_t k = 0; k < 3; ++k) {
        if (std::abs(at[k] - other.at[k]) > 1) {
          return false;
        }
      }
      return true;
    }
  };

  /// The costs of kRun neighbouring places along x; entries past the last place are meaningless.
  [[nodiscard]] std::array<std::uint16_t, kRun> costs_from(int x, int y, int z) const {
    const std::uint8_t* const from =
        cells_.cost.data() + kPlaceStep * (z * cells_.slice() + y * cells_.row()) + x;
    std::array<std::uint16_t, kRun> sums{};
    for (const std::ptrdiff_t offset : offsets_) {
      const std::uint8_t* const run = from + offset;
      for (std::size_t i = 0; i < kRun; ++i) {
        sums[i] = static_cast<std::uint16_t>(sums[i] + run[i]);
      }
    }
    return sums;
  }

  static void take(const Place& place, std::array<Place, 2>& best) {
    if (place.cost >= best[1].cost) {
      return;
    }
    if (place.cost < best[0].cost) {
      if (best[0].cost != kNone && !place.is_next_to(best[0])) {
        best[1] = best[0];
      }
      best[0] = place;
    } else if (!place.is_next_to(best[0])) {
      best[1] = place;
    }
  }

  const SearchField::Cells& cells_;
  std::span<const Vec3> points_m_;
  std::vector<std::ptrdiff_t> offsets_;
  Vec3 low_m_;
  std::array<int, 3> steps_{};
};

void keep_best(std::vector<Scored>& poses, std::size_t count) {
  if (poses.size() > count) {
    std::nth_element(poses.begin(), poses.begin() + static_cast<std::ptrdiff_t>(count), poses.end(),
                     is_better);
    poses.resize(count);
  }
  std::stable_sort(poses.begin(), poses.end(), is_better);
}

/// Drops poses next to a better one; `poses` is sorted.
void drop_neighbours(std::vector<Scored>& poses, double same_m, double same_rad,
                     std::size_t count) {
  std::vector<Scored> kept;
  for (const Scored& pose : poses) {
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const Scored& k) {
      return (k.pose.centre_m - pose.pose.centre_m).norm() < same_m &&
             rotation_angle_rad(k.pose.rotation, pose.pose.rotation) < same_rad;
    });
    if (is_new) {
      kept.push_back(pose);
    }
    if (kept.size() == count) {
      break;
    }
  }
  poses = std::move(kept);
}

struct Stage {
  int steps = 0;
  double from_width_m = 0.0;  ///< of the robust weight
  double to_width_m = 0.0;
};

void refine(const SearchField& vertebra, std::span<const Vec3> points_m, const Stage& stage,
            double tip_radius_m, Scored& scored) {
  FieldStep step(vertebra.field(), tip_radius_m);
  for (int i = 0; i < stage.steps; ++i) {
    const double fraction = stage.steps > 1 ? static_cast<double>(i) / (stage.steps - 1) : 1.0;
    const double width_m =
        stage.from_width_m * std::pow(stage.to_width_m / stage.from_width_m, fraction);
    if (!step.improve(points_m, width_m, scored.pose)) {
      break;
    }
  }
  scored.cost = step.cost_m2(points_m, stage.to_width_m, scored.pose);
}

}  // namespace

SearchField::SearchField(const TriangleMesh& reachable, const SurfaceIndex& reachable_surface,
                         const SurfaceIndex& bone)
    : SearchField(bounds_of(reachable),
                  DistanceField(reachable, reachable_surface, bone, kFieldCell_m, kFieldMargin_m)) {
}

Result<SearchField> SearchField::restored(const TriangleMesh& reachable,
                                          const SurfaceIndex& reachable_surface,
                                          const SurfaceIndex& bone, std::vector<float> samples_m) {
  auto field = DistanceField::restored(reachable, reachable_surface, bone, kFieldCell_m,
                                       kFieldMargin_m, std::move(samples_m));
  if (!field) {
    return field.error();
  }
  return SearchField(bounds_of(reachable), std::move(*field));
}

SearchField::SearchField(const Bounds& reachable_bounds, DistanceField field)
    : reachable_bounds_(reachable_bounds), field_(std::move(field)) {
  const double pad_m = kReach_m + 2.0 * kSearchCell_m;
  const Vec3 pad{pad_m, pad_m, pad_m};
  cells_.low_m = reachable_bounds_.low - pad;
  cells_.cell_m = kSearchCell_m;
  const Vec3 extent = reachable_bounds_.high + pad - cells_.low_m;
  for (std::size_t k = 0; k < 3; ++k) {
    cells_.size[k] = 1 + static_cast<int>(extent[static_cast<int>(k)] / kSearchCell_m);
  }
  // Padding: a run may reach past the end of the last row.
  cells_.cost.resize(static_cast<std::size_t>(cells_.slice() * cells_.size[2] + Cells::kRun));
  for (int z = 0; z < cells_.size[2]; ++z) {
    for (int y = 0; y < cells_.size[1]; ++y) {
      for (int x = 0; x < cells_.size[0]; ++x) {
        DistanceField::Value value;
        const bool near =
            field_.at(cells_.low_m + kSearchCell_m * Vec3{x + 0.5, y + 0.5, z + 0.5}, value);
        const double distance =
            near ? std::min(std::abs(value.distance_m), kFarthest_m) : kFarthest_m;
        const double factor = near && value.distance_m < 0.0 ? kInsideFactor : 1.0;
        cells_.cost[static_cast<std::size_t>(cells_.index(x, y, z))] =
            static_cast<std::uint8_t>(kCostPerM * factor * distance);
      }
    }
  }
}

std::vector<FoundPose> search_poses(const SearchField& vertebra,
                                    std::span<const Vec3> points_in_world_m,
                                    const PoseSearchOptions& options) {
  const SpreadPoints spread(points_in_world_m, kReach_m);
  if (spread.centred_m().size() < 6) {
    return {};
  }
  std::vector<Scored> poses;
  poses.reserve(2 * kRotations);
  {
    PlaceScan places(vertebra, spread.first(kPointsAdded));
    for (const Mat3& rotation : all_rotations()) {
      places.scan(rotation, poses);
    }
  }
  keep_best(poses, kKeptFirst);
  for (Scored& pose : poses) {
    refine(vertebra, spread.first(kPointsFirst), {4, 0.012, 0.006}, options.tip_radius_m, pose);
  }
  keep_best(poses, kKeptThen);
  for (Scored& pose : poses) {
    refine(vertebra, spread.first(kPointsThen), {6, 0.008, 0.004}, options.tip_radius_m, pose);
  }
  keep_best(poses, kKeptThen);
  drop_neighbours(poses, options.same_m, options.same_rad, kKeptLast);
  for (Scored& pose : poses) {
    refine(vertebra, spread.first(kPointsLast), {8, 0.005, 0.003}, options.tip_radius_m, pose);
  }
  keep_best(poses, kKeptLast);
  drop_neighbours(poses, options.same_m, options.same_rad, options.most);
  std::vector<FoundPose> found;
  for (const Scored& pose : poses) {
    found.push_back({world_from(pose.pose, spread.centre_m()), pose.cost});
  }
  return found;
}

}  // namespace orthonav::nav
