#include "nav/registration/search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <Eigen/Dense>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace orthonav::nav {
namespace {

// ---------------------------------------------------------------------------------------------
// A few points that stand for all.

constexpr double kSpreadCell_m = 0.004;
/// At most this fraction of the points is left out for lying in sparse cells.
constexpr double kLonelyFraction = 0.15;

/// The median of each coordinate, which outliers hardly move.
Vec3 middle_of(std::span<const Point<World>> points) {
  Vec3 middle;
  std::vector<double> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      values[i] = points[i].v[axis];
    }
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), at, values.end());
    middle[axis] = *at;
  }
  return middle;
}

/// Each next point is the one farthest from all before it.
void order_by_distance(std::vector<Vec3>& points_m, std::size_t count) {
  std::vector<double> distance2(points_m.size(), 1e9);
  for (std::size_t i = 0; i < std::min(count, points_m.size()); ++i) {
    std::size_t farthest = i;
    for (std::size_t k = i; k < points_m.size(); ++k) {
      if (distance2[k] > distance2[farthest]) {
        farthest = k;
      }
    }
    std::swap(points_m[i], points_m[farthest]);
    std::swap(distance2[i], distance2[farthest]);
    for (std::size_t k = i + 1; k < points_m.size(); ++k) {
      distance2[k] = std::min(distance2[k], (points_m[k] - points_m[i]).squared_norm());
    }
  }
}

struct Cell {
  Vec3 point;  ///< the first one in the cell
  std::size_t count = 0;
};

/// One point per cell within `reach_m` of the middle, in the order of the cells' places.
std::vector<Cell> cells_around(Vec3 middle, std::span<const Point<World>> points, double reach_m) {
  std::map<std::array<long, 3>, Cell> by_place;
  for (const Point<World>& p : points) {
    const Vec3 q = p.v - middle;
    if (!(q.norm() < reach_m)) {
      continue;
    }
    const auto place = [](double v) { return std::lround(v / kSpreadCell_m); };
    ++by_place.try_emplace({place(q.x), place(q.y), place(q.z)}, Cell{q}).first->second.count;
  }
  std::vector<Cell> cells;
  for (const auto& [place, cell] : by_place) {
    cells.push_back(cell);
  }
  return cells;
}

/// Drops sparse cells: outliers are few but far apart, so each would get a cell of its own.
void drop_isolated_cells(std::vector<Cell>& cells) {
  std::size_t all = 0;
  for (const Cell& cell : cells) {
    all += cell.count;
  }
  std::stable_sort(cells.begin(), cells.end(),
                   [](const Cell& a, const Cell& b) { return a.count > b.count; });
  auto droppable = static_cast<std::size_t>(kLonelyFraction * static_cast<double>(all));
  while (cells.size() > 6 && cells.back().count <= droppable &&
         2 * cells.back().count < cells[cells.size() / 2].count) {
    droppable -= cells.back().count;
    cells.pop_back();
  }
}

/// The points of a cloud about their centre, ordered such that the first n, for any n up to 150,
/// are spread evenly over it, no matter how often a place was stroked.
class SpreadPoints {
 public:
  /// Leaves out points farther than `reach_m` from the middle.
  SpreadPoints(std::span<const Point<World>> points, double reach_m) {
    if (points.empty()) {
      return;
    }
    const Vec3 middle = middle_of(points);
    std::vector<Cell> cells = cells_around(middle, points, reach_m);
    drop_isolated_cells(cells);
    Vec3 mean;
    for (const Cell& cell : cells) {
      mean += cell.point / static_cast<double>(cells.size());
    }
    centre_m_ = middle + mean;
    for (const Cell& cell : cells) {
      if ((cell.point - mean).norm() < reach_m) {
        points_m_.push_back(cell.point - mean);
      }
    }
    constexpr std::size_t kOrdered = 150;
    order_by_distance(points_m_, kOrdered);
  }

  [[nodiscard]] Vec3 centre_m() const { return centre_m_; }
  [[nodiscard]] std::span<const Vec3> centred_m() const { return points_m_; }
  [[nodiscard]] std::span<const Vec3> first(std::size_t count) const {
    return std::span<const Vec3>(points_m_).first(std::min(count, points_m_.size()));
  }

 private:
  Vec3 centre_m_;
  std::vector<Vec3> points_m_;
};

// ---------------------------------------------------------------------------------------------
// Steps of a pose in the distance field.

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// The longest step.
constexpr double kLongestStep_m = 0.008;
constexpr double kWidest_rad = 0.3;
/// Damping relative to the trace: keeps directions that nothing constrains from running away.
constexpr double kDamping = 1e-4;

/// Vertebra from points about their centre: the position of the centre, and the rotation.
struct CentredPose {
  Mat3 rotation = Mat3::identity();
  Vec3 centre_m;
};

/// The normal equations of a step, one point at a time. Sums of the lower triangle by rows, then of
/// the right-hand side: plain arrays, since most of the search's time is spent here.
struct StepSums {
  std::array<double, 27> sums{};
  int used = 0;

  void add(Vec3 lever_arm, Vec3 gradient, double residual_m, double weight) {
    const Vec3 by_rotation = lever_arm.cross(gradient);
    const std::array<double, 6> j = {gradient.x,    gradient.y,    gradient.z,
                                     by_rotation.x, by_rotation.y, by_rotation.z};
    std::size_t k = 0;
    for (std::size_t row = 0; row < 6; ++row) {
      const double weighted = weight * j[row];
      for (std::size_t column = 0; column <= row; ++column) {
        sums[k++] += weighted * j[column];
      }
      sums[21 + row] -= weighted * residual_m;
    }
    ++used;
  }
};

/// (translation, rotation vector); not finite where the points do not determine it.
Vector6 damped_step(const StepSums& of) {
  Matrix6 normal;
  Vector6 right;
  std::size_t k = 0;
  for (Eigen::Index row = 0; row < 6; ++row) {
    for (Eigen::Index column = 0; column <= row; ++column) {
      normal(row, column) = normal(column, row) = of.sums[k++];
    }
    right(row) = of.sums[21 + static_cast<std::size_t>(row)];
  }
  const double translation_damping = kDamping * normal.topLeftCorner<3, 3>().trace();
  const double rotation_damping = kDamping * normal.bottomRightCorner<3, 3>().trace();
  for (int i = 0; i < 6; ++i) {
    normal(i, i) += i < 3 ? translation_damping : rotation_damping;
  }
  return normal.ldlt().solve(right);
}

/// Moves the pose by a step, or by as much of it as is allowed at once.
void move_by(const Vector6& step, CentredPose& pose) {
  const double scale = std::min({1.0, kLongestStep_m / std::max(step.head<3>().norm(), 1e-12),
                                 kWidest_rad / std::max(step.tail<3>().norm(), 1e-12)});
  const Vec3 rotation{step(3), step(4), step(5)};
  pose.rotation = orthonormalized(rotation_from_vector(scale * rotation) * pose.rotation);
  pose.centre_m += scale * Vec3{step(0), step(1), step(2)};
}

struct Scored {
  CentredPose pose;
  double cost = 0.0;
};

struct Stage {
  int steps = 0;
  double from_width_m = 0.0;  ///< of the robust weight
  double to_width_m = 0.0;
};

/// Robust Gauss-Newton steps (weights by Tukey's biweight) with a width that narrows, as long as
/// the points within it determine the pose. The cost is then the mean of the squared distances,
/// truncated at the last width.
void refine(const DistanceField& field, std::span<const Vec3> centred_m, const Stage& stage,
            double tip_radius_m, Scored& scored) {
  CentredPose& pose = scored.pose;
  for (int i = 0; i < stage.steps; ++i) {
    const double fraction = stage.steps > 1 ? static_cast<double>(i) / (stage.steps - 1) : 1.0;
    const double width_m =
        stage.from_width_m * std::pow(stage.to_width_m / stage.from_width_m, fraction);
    const double inverse_width2 = 1.0 / (width_m * width_m);
    StepSums sums;
    for (const Vec3& p : centred_m) {
      const Vec3 lever_arm = pose.rotation * p;
      DistanceField::Value value;
      if (!field.at(lever_arm + pose.centre_m, value)) {
        continue;
      }
      const double r = value.distance_m - tip_radius_m;
      const double t = 1.0 - r * r * inverse_width2;
      if (t > 0.0) {
        sums.add(lever_arm, value.gradient, r, t * t);
      }
    }
    if (sums.used < 6) {
      break;
    }
    const Vector6 step = damped_step(sums);
    if (!step.allFinite()) {
      break;
    }
    move_by(step, pose);
  }
  double sum = 0.0;
  for (const Vec3& p : centred_m) {
    DistanceField::Value value;
    const double r = field.at(pose.rotation * p + pose.centre_m, value)
                         ? std::min(std::abs(value.distance_m - tip_radius_m), stage.to_width_m)
                         : stage.to_width_m;
    sum += r * r;
  }
  scored.cost = sum / static_cast<double>(std::max<std::size_t>(1, centred_m.size()));
}

// ---------------------------------------------------------------------------------------------
// Every pose.

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
void drop_neighbours(std::vector<Scored>& poses, std::size_t count) {
  std::vector<Scored> kept;
  for (const Scored& pose : poses) {
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const Scored& k) {
      return (k.pose.centre_m - pose.pose.centre_m).norm() < kSamePose_m &&
             rotation_angle_rad(k.pose.rotation, pose.pose.rotation) < kSamePose_rad;
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

constexpr Stage kLast{8, 0.005, 0.003};

Transform<World, Vertebra> world_from(const CentredPose& pose, Vec3 points_centre_m) {
  const Mat3 back = pose.rotation.transposed();
  return {back, points_centre_m - back * pose.centre_m};
}

}  // namespace

std::vector<FoundPose> search_poses(const SearchField& vertebra,
                                    std::span<const Point<World>> points, double tip_radius_m,
                                    std::size_t most) {
  const SpreadPoints spread(points, SearchField::kReach_m);
  if (spread.centred_m().size() < 6) {
    return {};
  }
  std::vector<Scored> poses;
  poses.reserve(2 * kRotations);
  PlaceScan places(vertebra, spread.first(kPointsAdded));
  for (const Mat3& rotation : all_rotations()) {
    places.scan(rotation, poses);
  }
  const auto refine_all = [&](std::size_t count, const Stage& stage) {
    for (Scored& pose : poses) {
      refine(vertebra.field(), spread.first(count), stage, tip_radius_m, pose);
    }
  };
  keep_best(poses, kKeptFirst);
  refine_all(kPointsFirst, {4, 0.012, 0.006});
  keep_best(poses, kKeptThen);
  refine_all(kPointsThen, {6, 0.008, 0.004});
  keep_best(poses, kKeptThen);
  drop_neighbours(poses, kKeptLast);
  refine_all(kPointsLast, kLast);
  keep_best(poses, kKeptLast);
  drop_neighbours(poses, most);
  std::vector<FoundPose> found;
  for (const Scored& pose : poses) {
    found.push_back({world_from(pose.pose, spread.centre_m()), pose.cost});
  }
  return found;
}

FoundPose refined_pose(const SearchField& vertebra, std::span<const Point<World>> points,
                       std::span<const Transform<World, Vertebra>> starts, double tip_radius_m) {
  const std::size_t step = std::max<std::size_t>(1, points.size() / kPointsLast);
  std::vector<Vec3> few_m;
  for (std::size_t i = 0; i < points.size(); i += step) {
    few_m.push_back(points[i].v);
  }
  Vec3 centre_m;
  for (const Vec3& p : few_m) {
    centre_m += p / static_cast<double>(few_m.size());
  }
  for (Vec3& p : few_m) {
    p -= centre_m;
  }
  Scored best{{}, std::numeric_limits<double>::infinity()};
  for (const Transform<World, Vertebra>& start : starts) {
    const auto from_world = start.inverse();
    Scored scored{{from_world.rotation(), (from_world * Point<World>{centre_m}).v}, 0.0};
    refine(vertebra.field(), few_m, kLast, tip_radius_m, scored);
    if (is_better(scored, best)) {
      best = scored;
    }
  }
  return {world_from(best.pose, centre_m), best.cost};
}

std::vector<Transform<World, Vertebra>> poses_beside(Vec3 centre_m) {
  constexpr double kAside_m = 0.003;
  constexpr double kTurned_rad = 0.15;
  std::vector<Transform<World, Vertebra>> poses(1);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 along;
      along[axis] = side;
      const Mat3 turned = rotation_from_vector(kTurned_rad * along);
      poses.push_back({Mat3::identity(), kAside_m * along});
      poses.push_back({turned, centre_m - turned * centre_m});
    }
  }
  return poses;
}

}  // namespace orthonav::nav
