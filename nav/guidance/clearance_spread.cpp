#include "nav/guidance/clearance_spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "nav/geometry/surface_depth.h"

namespace orthonav::nav {
namespace {

constexpr std::size_t kMotions = 1024;
constexpr std::size_t kSix = 6;
/// Largest distance between rows along the screw, and the places in each row: with 30° between
/// them, at most 1 - cos(15°) = 3 % of a motion is missed.
constexpr double kRow_m = 0.003;
constexpr int kPlacesInRow = 12;
/// A place that would have to move by more SDs than this to become nearer to the wall than the
/// nearest place is skipped: it happens in one of 4000 cases.
constexpr double kWorth_sd = 3.5;

using Six = std::array<double, kSix>;
/// Lower triangle: its product with its transpose is the covariance.
using Root = std::array<Six, kSix>;

/// Standard normal motions, component by component.
using Motions = std::array<std::array<double, kMotions>, kSix>;

Motions made_motions() {
  // The positive root of x^7 = x + 1.
  constexpr double kRoot = 1.1127756842787055;
  Motions motions;
  double step = 1.0;
  for (auto& component : motions) {
    step /= kRoot;
    for (std::size_t i = 0; i < kMotions; ++i) {
      const double at = 0.5 + step * (static_cast<double>(i) + 1.0);
      component[i] = normal_quantile(at - std::floor(at));
    }
  }
  return motions;
}

const Motions& standard_motions() {
  static const Motions kMade = made_motions();
  return kMade;
}

/// Cholesky; a direction without variance, or with a variance below zero from rounding, gives 0.
Root root_of(const std::array<double, 36>& covariance) {
  constexpr double kNothing = 1e-12;
  Root root{};
  for (std::size_t c = 0; c < kSix; ++c) {
    double pivot = covariance[7 * c];
    for (std::size_t k = 0; k < c; ++k) {
      pivot -= root[c][k] * root[c][k];
    }
    if (!(pivot > kNothing * covariance[7 * c])) {
      continue;
    }
    root[c][c] = std::sqrt(pivot);
    for (std::size_t r = c + 1; r < kSix; ++r) {
      double sum = covariance[6 * r + c];
      for (std::size_t k = 0; k < c; ++k) {
        sum -= root[r][k] * root[c][k];
      }
      root[r][c] = sum / root[c][c];
    }
  }
  return root;
}

/// How a place's depth changes with each standard normal component.
Six change(const Root& root, Vec3 deeper, Vec3 from_centre_m) {
  const Vec3 by_rotation = from_centre_m.cross(deeper);
  const Six by_motion = {deeper.x, deeper.y, deeper.z, by_rotation.x, by_rotation.y, by_rotation.z};
  Six out{};
  for (std::size_t k = 0; k < kSix; ++k) {
    for (std::size_t r = k; r < kSix; ++r) {
      out[k] += root[r][k] * by_motion[r];
    }
  }
  return out;
}

double length_between(const Six& a, const Six& b) {
  double squares = 0.0;
  for (std::size_t k = 0; k < kSix; ++k) {
    squares += (a[k] - b[k]) * (a[k] - b[k]);
  }
  return std::sqrt(squares);
}

/// The least depth in each motion over the places so far.
class LeastInEach {
 public:
  LeastInEach(double binding_m, const Six& binding) : binding_m_(binding_m), binding_(binding) {
    least_m_.fill(1e9);
    take(binding_m, binding);
  }

  void add(double depth_m, const Six& by) {
    if (depth_m - binding_m_ < kWorth_sd * length_between(by, binding_)) {
      take(depth_m, by);
    }
  }

  [[nodiscard]] ClearanceSpread spread() {
    ClearanceSpread out;
    for (const double clearance_m : least_m_) {
      out.grade_probability[static_cast<std::size_t>(grade_of(clearance_m))] += 1.0 / kMotions;
    }
    constexpr std::size_t kBelow = kMotions / 20;
    std::nth_element(least_m_.begin(), least_m_.begin() + kBelow, least_m_.end());
    out.lower_95_m = least_m_[kBelow];
    return out;
  }

 private:
  void take(double depth_m, const Six& by) {
    const Motions& m = standard_motions();
    for (std::size_t i = 0; i < kMotions; ++i) {
      const double there_m = depth_m + by[0] * m[0][i] + by[1] * m[1][i] + by[2] * m[2][i] +
                             by[3] * m[3][i] + by[4] * m[4][i] + by[5] * m[5][i];
      least_m_[i] = there_m < least_m_[i] ? there_m : least_m_[i];
    }
  }

  double binding_m_;
  Six binding_;
  std::array<double, kMotions> least_m_;
};

bool is_known(const PoseUncertainty& pose) {
  const auto& c = pose.covariance();
  return pose.centre_m().is_finite() &&
         std::all_of(c.begin(), c.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

std::optional<ClearanceSpread> clearance_spread(const SurfaceIndex& bone,
                                                const ScrewCylinder& screw,
                                                const Clearance& clearance,
                                                const PoseUncertainty& pose) {
  const auto surface = CylinderSurface::of(screw);
  DepthProbe depths(bone);
  const auto binding = depths.at(clearance.place.v);
  if (!surface || !binding || !is_known(pose)) {
    return std::nullopt;
  }
  const Root root = root_of(pose.covariance());
  const auto changes = [&](const SurfaceDepth& depth, Vec3 place_m) {
    return change(root, depth.deeper, place_m - pose.centre_m());
  };
  LeastInEach least(clearance.clearance_m, changes(*binding, clearance.place.v));
  // The tip's rim is the last row of the side.
  const auto rows = static_cast<int>(std::ceil(surface->side_m() / kRow_m));
  const auto rings = static_cast<int>(std::ceil(surface->radius_m() / kRow_m));
  for (int row = 0; row <= rows + rings; ++row) {
    const double along_m = row <= rows
                               ? surface->side_m() * row / rows
                               : surface->side_m() + surface->radius_m() * (row - rows) / rings;
    const int around = row == rows + rings ? 1 : kPlacesInRow;  // the tip's middle
    for (int k = 0; k < around; ++k) {
      const Vec3 place = surface->at(along_m, 2.0 * std::numbers::pi * k / kPlacesInRow).v;
      if (const auto depth = depths.at(place)) {
        least.add(depth->depth_m, changes(*depth, place));
      }
    }
  }
  return least.spread();
}

PoseUncertainty with_tool(const PoseUncertainty& bone,
                          const Transform<Vertebra, World>& vertebra_from_world,
                          Point<Vertebra> origin_in_vertebra, const PoseCovariance& tool_in_world) {
  // About the bone's centre, a motion (t, w) about the tool's origin is (R t + R w × d, R w).
  const Vec3 d = bone.centre_m() - origin_in_vertebra.v;
  const Mat3& r = vertebra_from_world.rotation();
  std::array<Six, kSix> moves{};
  for (int c = 0; c < 3; ++c) {
    const Vec3 axis = r.column(static_cast<std::size_t>(c));
    const Vec3 swung = axis.cross(d);
    for (int k = 0; k < 3; ++k) {
      const auto row = static_cast<std::size_t>(k);
      const auto column = static_cast<std::size_t>(c);
      moves[row][column] = axis[k];
      moves[row][column + 3] = swung[k];
      moves[row + 3][column + 3] = axis[k];
    }
  }
  auto sum = bone.covariance();
  for (std::size_t i = 0; i < kSix; ++i) {
    for (std::size_t j = 0; j < kSix; ++j) {
      for (std::size_t a = 0; a < kSix; ++a) {
        for (std::size_t b = 0; b < kSix; ++b) {
          sum[6 * i + j] += moves[i][a] * tool_in_world[6 * a + b] * moves[j][b];
        }
      }
    }
  }
  return {bone.centre_m(), sum};
}

std::optional<ScrewClearance> screw_clearance(const SurfaceIndex& bone, const ScrewCylinder& screw,
                                              const PoseUncertainty* pose) {
  const auto least = least_clearance(bone, screw);
  if (!least) {
    return std::nullopt;
  }
  ScrewClearance out{*least, std::nullopt};
  if (pose != nullptr) {
    out.spread = clearance_spread(bone, screw, *least, *pose);
  }
  return out;
}

}  // namespace orthonav::nav
