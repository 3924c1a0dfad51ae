#include "nav/registration/residual_units.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "nav/registration/cells.h"

namespace orthonav::nav {
namespace {

constexpr double kLeap_m = 0.008;
constexpr double kShortest_m = 0.004;
constexpr double kSmallestCell_m = 0.005;
constexpr double kLargestCell_m = 0.1;
constexpr double kGrows = 1.25;

/// Two samples this close are the same one, repeated or resampled. A moving hand moves farther, and
/// tracking noise scatters a resting one by more.
constexpr double kSamePoint_m = 0.00005;

/// The places seen so far, in cells, so that only a few cells near a place have to be searched.
class SeenPlaces {
 public:
  explicit SeenPlaces(std::size_t count) : next_(count), places_m_(count) {
    heads_.assign(std::bit_ceil(2 * std::max<std::size_t>(count, 1)), kNone);
  }
  /// Whether no place was seen near it; it then counts as seen.
  bool is_new(Vec3 p) {
    const GridCell low = cell(p - Vec3{kSamePoint_m, kSamePoint_m, kSamePoint_m});
    const GridCell high = cell(p + Vec3{kSamePoint_m, kSamePoint_m, kSamePoint_m});
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          if (is_near_one_in({x, y, z}, p)) {
            return false;
          }
        }
      }
    }
    const std::size_t head = bucket(cell(p));
    places_m_[seen_] = p;
    next_[seen_] = heads_[head];
    heads_[head] = static_cast<std::uint32_t>(seen_++);
    return true;
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  static GridCell cell(Vec3 p) { return cell_of(p, 4.0 * kSamePoint_m); }
  [[nodiscard]] std::size_t bucket(const GridCell& cell) const {
    return HashOfCell{}(cell) & (heads_.size() - 1);
  }
  [[nodiscard]] bool is_near_one_in(const GridCell& cell, Vec3 p) const {
    for (std::uint32_t i = heads_[bucket(cell)]; i != kNone; i = next_[i]) {
      if ((places_m_[i] - p).squared_norm() <= kSamePoint_m * kSamePoint_m) {
        return true;
      }
    }
    return false;
  }

  std::vector<std::uint32_t> heads_;
  std::vector<std::uint32_t> next_;
  std::vector<Vec3> places_m_;
  std::size_t seen_ = 0;
};

/// A repeated point adds nothing, even if others came in between.
std::vector<std::uint32_t> different_points(const SurfaceFit& fit) {
  SeenPlaces seen(fit.points.size());
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < fit.points.size(); ++i) {
    const FittedPoint& p = fit.points[i];
    if (p.inlier_precision() > 0.0 && seen.is_new(p.lever_arm_m)) {
      out.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return out;
}

/// Numbers the strokes; returns how long all of them are.
double find_strokes(const SurfaceFit& fit, ResidualUnits& out, std::vector<double>& along_m) {
  double length_m = 0.0;
  int stroke = 0;
  for (std::size_t k = 0; k < out.order.size(); ++k) {
    if (k > 0) {
      const double step_m =
          (fit.points[out.order[k]].lever_arm_m - fit.points[out.order[k - 1]].lever_arm_m).norm();
      stroke += step_m > kLeap_m ? 1 : 0;
      length_m += step_m > kLeap_m ? 0.0 : step_m;
    }
    along_m.push_back(length_m);
    out.stroke.push_back(stroke);
  }
  return length_m;
}

/// Fills in a unit's values from its points in this fit.
void fill(const SurfaceFit& fit, const ResidualUnits& units, ResidualUnit& unit) {
  unit.weight = unit.height_m = 0.0;
  unit.derivative = {};
  for (const std::uint32_t i : units.points_of(unit)) {
    const FittedPoint& p = fit.points[i];
    const double weight = p.inlier_precision();
    const Vec3 by_rotation = p.lever_arm_m.cross(p.gradient);
    const double by_size = -p.lever_arm_m.dot(p.gradient);
    const std::array<double, kHeightUnknowns> j = {p.gradient.x,  p.gradient.y,  p.gradient.z,
                                                   by_rotation.x, by_rotation.y, by_rotation.z,
                                                   -1.0,          by_size};
    unit.weight += weight;
    unit.height_m += weight * (p.residual_m + fit.standoff_m);
    for (std::size_t k = 0; k < j.size(); ++k) {
      unit.derivative[k] += weight * j[k];
    }
  }
  unit.height_m /= unit.weight;
  for (double& d : unit.derivative) {
    d /= unit.weight;
  }
  const std::size_t count = unit.end - unit.first;
  unit.halves_m = {fit.points[units.order[unit.first + count / 4]].lever_arm_m,
                   fit.points[units.order[unit.first + (3 * count) / 4]].lever_arm_m};
}

void add_unit(const SurfaceFit& fit, std::size_t first, std::size_t end, ResidualUnits& out) {
  ResidualUnit unit;
  unit.stroke = out.stroke[first];
  unit.first = first, unit.end = end;
  fill(fit, out, unit);
  out.all.push_back(unit);
}

void cut_strokes(const SurfaceFit& fit, const std::vector<double>& along_m, double unit_m,
                 ResidualUnits& out) {
  std::size_t first = 0;
  for (std::size_t k = 1; k <= out.order.size(); ++k) {
    if (k == out.order.size() || out.stroke[k] != out.stroke[first] ||
        along_m[k] - along_m[first] >= unit_m) {
      add_unit(fit, first, k, out);
      first = k;
    }
  }
}

/// For unordered points: each cell of space is a unit and a stroke of its own.
void cut_space(const SurfaceFit& fit, std::size_t most, ResidualUnits& out) {
  std::map<std::array<long, 3>, std::vector<std::uint32_t>> cells;
  for (double cell_m = kSmallestCell_m; cell_m < kLargestCell_m; cell_m *= kGrows) {
    cells.clear();
    for (const std::uint32_t i : out.order) {
      const Vec3 p = fit.points[i].lever_arm_m / cell_m;
      cells[{std::lround(p.x), std::lround(p.y), std::lround(p.z)}].push_back(i);
    }
    if (cells.size() <= most) {
      break;
    }
  }
  out.order.clear();
  out.stroke.clear();
  int stroke = 0;
  for (const auto& [cell, points] : cells) {
    const std::size_t first = out.order.size();
    out.order.insert(out.order.end(), points.begin(), points.end());
    out.stroke.resize(out.order.size(), stroke++);
    add_unit(fit, first, out.order.size(), out);
  }
}

}  // namespace

ResidualUnits refilled(const ResidualUnits& units, const SurfaceFit& fit) {
  ResidualUnits out = units;
  for (ResidualUnit& unit : out.all) {
    fill(fit, out, unit);
  }
  return out;
}

ResidualUnits residual_units(const SurfaceFit& fit, std::size_t most) {
  ResidualUnits out;
  out.order = different_points(fit);
  if (out.order.empty()) {
    return out;
  }
  std::vector<double> along_m;
  const double length_m = find_strokes(fit, out, along_m);
  const auto strokes = static_cast<std::size_t>(out.stroke.back()) + 1;
  out.along_strokes = 2 * strokes < std::min(most, out.order.size());
  if (out.along_strokes) {
    const double room = static_cast<double>(most - strokes);
    cut_strokes(fit, along_m, std::max(kShortest_m, length_m / room), out);
  } else {
    cut_space(fit, most, out);
  }
  return out;
}

}  // namespace orthonav::nav
