#include "nav/guidance/rod_stroke.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/length_text.h"
#include "base/printed.h"
#include "nav/geometry/absolute_orientation.h"
#include "nav/registration/principal_axes.h"
#include "nav/statistics/levenberg_marquardt.h"

namespace orthonav::nav {
namespace {

/// Points within this length of the rod form one block when their common error is estimated.
constexpr double kStrokeBlock_m = 0.01;
// A rod that is nearly straight may lie anywhere about its axis: far beyond any misfit.
constexpr double kPoseRotationSd_rad = 1.0;
constexpr double kPoseTranslationSd_m = 0.05;
// A few steps tell which side of the rod was stroked.
constexpr int kFirstIterations = 6;
constexpr int kAllIterations = 40;
constexpr std::size_t kStrokeAngle = 6;
constexpr std::size_t kStrokeRoll = 7;

struct StrokeFoot {
  double distance_m = std::numeric_limits<double>::infinity();
  double along_m = 0.0;  ///< of the chain, from its first end
};

StrokeFoot stroke_foot(const std::vector<Vec3>& chain_m, Vec3 at_m) {
  StrokeFoot nearest;
  double before_m = 0.0;
  for (std::size_t i = 0; i + 1 < chain_m.size(); ++i) {
    const Vec3 chord_m = chain_m[i + 1] - chain_m[i];
    const double length_m = chord_m.norm();
    if (length_m > 0.0) {
      const double along_m = std::clamp((at_m - chain_m[i]).dot(chord_m) / length_m, 0.0, length_m);
      const double distance_m = (at_m - chain_m[i] - (along_m / length_m) * chord_m).norm();
      if (distance_m < nearest.distance_m) {
        nearest = {distance_m, before_m + along_m};
      }
    }
    before_m += length_m;
  }
  return nearest;
}

/// A rod that was stroked, with its last bend and its pose as parameters: turn and shift of the
/// pose, then the bend's angle and roll.
class StrokedRod {
 public:
  StrokedRod(std::span<const RodArc> arcs, double length_m, double radius_m,
             std::span<const Vec3> points_m, const RodStrokeRules& rules)
      : arcs_(arcs.begin(), arcs.end()),
        length_m_(length_m),
        radius_m_(radius_m),
        points_m_(points_m),
        rules_(rules),
        tip_sd_m_(rules.tip_sd_m) {}

  void begin_at(const Mat3& rotation) { start_ = rotation; }
  [[nodiscard]] Mat3 rotation(std::span<const double> p) const {
    return rotation_from_vector({p[0], p[1], p[2]}) * start_;
  }
  void set_tip_sd_m(double sd_m) { tip_sd_m_ = sd_m; }
  [[nodiscard]] RodArc bend(std::span<const double> p) const {
    RodArc arc = arcs_.back();
    arc.angle_rad = p[kStrokeAngle];
    arc.roll_rad = p[kStrokeRoll];
    return arc;
  }
  [[nodiscard]] std::vector<StrokeFoot> feet(std::span<const double> p) const {
    std::vector<RodArc> arcs = arcs_;
    arcs.back() = bend(p);
    const std::vector<Vec3> chain_m = rod_axis(arcs, length_m_);
    const Mat3 back = rotation(p).transposed();
    std::vector<StrokeFoot> feet;
    feet.reserve(points_m_.size());
    for (const Vec3& point_m : points_m_) {
      feet.push_back(stroke_foot(chain_m, back * (point_m - Vec3{p[3], p[4], p[5]})));
    }
    return feet;
  }
  void write(std::span<const double> p, std::vector<double>& out) const {
    out.clear();
    for (const StrokeFoot& foot : feet(p)) {
      out.push_back((foot.distance_m - radius_m_) / tip_sd_m_);
    }
    out.push_back((p[kStrokeAngle] - arcs_.back().angle_rad) / rules_.angle_sd_rad);
    out.push_back((p[kStrokeRoll] - arcs_.back().roll_rad) / rules_.roll_sd_rad);
    for (std::size_t i = 0; i < 3; ++i) {
      out.push_back(p[i] / kPoseRotationSd_rad);
      out.push_back((p[i + 3] - middle_m_[static_cast<int>(i)]) / kPoseTranslationSd_m);
    }
  }
  [[nodiscard]] Result<LeastSquares> fitted(const std::vector<double>& start, int iterations) {
    middle_m_ = {start[3], start[4], start[5]};
    return levenberg_marquardt(
        start, [&](std::span<const double> p, std::vector<double>& out) { write(p, out); },
        iterations);
  }

 private:
  std::vector<RodArc> arcs_;
  double length_m_;
  double radius_m_;
  std::span<const Vec3> points_m_;
  const RodStrokeRules& rules_;
  double tip_sd_m_;
  Mat3 start_ = Mat3::identity();
  Vec3 middle_m_;
};

Status check_stroke(std::span<const RodArc> arcs, std::span<const Vec3> stroked_m,
                    const RodStrokeRules& rules) {
  if (arcs.empty()) {
    return Error{"stroke of a rod without a bend: there is nothing to measure"};
  }
  if (stroked_m.size() < rules.fewest_points) {
    return Error{printed("stroke of the rod has %zu points, limit %zu", stroked_m.size(),
                         rules.fewest_points)};
  }
  for (std::size_t i = 0; i < stroked_m.size(); ++i) {
    if (!stroked_m[i].is_finite()) {
      return Error{printed("point %zu of the stroke is not finite", i + 1)};
    }
  }
  return {};
}

/// Positions along the main direction, scaled to [0, 1], increasing in the given order.
std::vector<double> parts_along(std::span<const Vec3> points_m) {
  const PrincipalAxes axes = principal_axes(points_m);
  std::vector<double> along;
  for (const Vec3& point_m : points_m) {
    along.push_back(axes.axes[0].dot(point_m));
  }
  // The mean product with the index: the direction in which the stroke ran.
  const double middle = 0.5 * static_cast<double>(along.size() - 1);
  double trend = 0.0;
  for (std::size_t i = 0; i < along.size(); ++i) {
    trend += (static_cast<double>(i) - middle) * along[i];
  }
  const auto [least, most] = std::minmax_element(along.begin(), along.end());
  const double low = *least;
  const double span = std::max(*most - low, 1e-9);
  for (double& a : along) {
    a = trend < 0.0 ? 1.0 - (a - low) / span : (a - low) / span;
  }
  return along;
}

/// For every point, the place on the axis at the same fraction of the rod's length.
std::vector<Vec3> partners_on(const std::vector<Vec3>& chain_m, std::span<const Vec3> points_m) {
  const std::vector<double> model = parts_along(chain_m);
  std::vector<Vec3> partners;
  for (const double part : parts_along(points_m)) {
    std::size_t i = 1;
    while (i + 1 < model.size() && model[i] < part) {
      ++i;
    }
    const double span = model[i] - model[i - 1];
    const double between = span > 0.0 ? std::clamp((part - model[i - 1]) / span, 0.0, 1.0) : 0.0;
    partners.push_back(chain_m[i - 1] + between * (chain_m[i] - chain_m[i - 1]));
  }
  return partners;
}

/// How much more the mean of points varies than with independent errors: the variance of block
/// means along the rod, times the points per block, over the variance of one point; at least 1.
double common_error_factor(const std::vector<StrokeFoot>& feet, double radius_m) {
  std::vector<std::pair<double, int>> blocks;
  double square = 0.0;
  for (const StrokeFoot& foot : feet) {
    const auto block = static_cast<std::size_t>(std::max(0.0, foot.along_m / kStrokeBlock_m));
    blocks.resize(std::max(blocks.size(), block + 1));
    blocks[block].first += foot.distance_m - radius_m;
    blocks[block].second += 1;
    square += (foot.distance_m - radius_m) * (foot.distance_m - radius_m);
  }
  double in_blocks = 0.0;
  for (const auto& [sum, count] : blocks) {
    in_blocks += sum * sum;
  }
  return square > 0.0 ? std::max(1.0, in_blocks / square) : 1.0;
}

double stroke_rms_m(const std::vector<StrokeFoot>& feet, double radius_m) {
  double square = 0.0;
  for (const StrokeFoot& foot : feet) {
    square += (foot.distance_m - radius_m) * (foot.distance_m - radius_m);
  }
  return std::sqrt(square / static_cast<double>(feet.size()));
}

/// Starts with the axis through the points, and with it shifted to the four sides, since only one
/// side may have been stroked.
Result<LeastSquares> first_fit(StrokedRod& rod, const RigidFit& laid, const RodArc& bend,
                               double radius_m) {
  const Vec3 x = radius_m * laid.rotation.column(0);
  const Vec3 y = radius_m * laid.rotation.column(1);
  const std::array<Vec3, 5> offsets_m = {Vec3{}, x, -x, y, -y};
  Result<LeastSquares> best = Error{"stroke of the rod can't be fitted"};
  for (const Vec3& offset_m : offsets_m) {
    const Vec3 at_m = laid.translation_m + offset_m;
    auto fit = rod.fitted({0, 0, 0, at_m.x, at_m.y, at_m.z, bend.angle_rad, bend.roll_rad},
                          kFirstIterations);
    if (fit && (!best || fit->sum_of_squares < best->sum_of_squares)) {
      best = std::move(fit);
    }
  }
  return best;
}

Status check_reach(const std::vector<StrokeFoot>& feet, const RodArc& bend, std::size_t number,
                   const RodStrokeRules& rules) {
  const auto [first, last] = std::minmax_element(
      feet.begin(), feet.end(),
      [](const StrokeFoot& a, const StrokeFoot& b) { return a.along_m < b.along_m; });
  const double beyond_m = 0.5 * bend.width_m + rules.beyond_bend_m;
  if (first->along_m > bend.centre_m - beyond_m || last->along_m < bend.centre_m + beyond_m) {
    return Error{printed(
        "stroke runs from %.0f to %.0f mm of the rod, must pass bend %zu at %.0f "
        "mm by %.0f mm",
        first->along_m * 1e3, last->along_m * 1e3, number, bend.centre_m * 1e3, beyond_m * 1e3)};
  }
  return {};
}

/// Fits to convergence before the points' errors are judged, since a misfit would be taken for a
/// common error; then fits again with those errors.
Result<LeastSquares> settled_fit(StrokedRod& rod, const RigidFit& laid, const RodArc& bend,
                                 double radius_m, const RodStrokeRules& rules) {
  auto fit = first_fit(rod, laid, bend, radius_m);
  if (!fit) {
    return fit;
  }
  fit = rod.fitted(std::vector<double>(fit->parameters), kAllIterations);
  if (!fit) {
    return fit;
  }
  const auto feet = rod.feet(fit->parameters);
  rod.set_tip_sd_m(std::max(rules.tip_sd_m, stroke_rms_m(feet, radius_m) *
                                                std::sqrt(common_error_factor(feet, radius_m))));
  return rod.fitted(std::vector<double>(fit->parameters), kAllIterations);
}

MeasuredBend bend_of(const StrokedRod& rod, const LeastSquares& fit, double rms_m) {
  const std::vector<double>& p = fit.parameters;
  const std::size_t n = p.size();
  return {.arc = rod.bend(p),
          .angle_se_rad = std::sqrt(fit.covariance[kStrokeAngle * n + kStrokeAngle]),
          .roll_se_rad = std::sqrt(fit.covariance[kStrokeRoll * n + kStrokeRoll]),
          .rms_m = rms_m,
          .points_from_rod = rod.rotation(p),
          .rod_in_points_m = {p[3], p[4], p[5]}};
}

}  // namespace

Result<MeasuredBend> measured_bend(std::span<const RodArc> arcs, double length_m, double diameter_m,
                                   std::span<const Vec3> stroked_m, const RodStrokeRules& rules) {
  if (const Status s = check_stroke(arcs, stroked_m, rules); !s) {
    return s.error();
  }
  const double radius_m = 0.5 * diameter_m;
  const auto laid =
      absolute_orientation(partners_on(rod_axis(arcs, length_m), stroked_m), stroked_m);
  if (!laid) {
    return Error{"stroke of the rod: " + laid.error().message, laid.error().code};
  }
  StrokedRod rod(arcs, length_m, radius_m, stroked_m, rules);
  rod.begin_at(laid->rotation);
  const auto fit = settled_fit(rod, *laid, arcs.back(), radius_m, rules);
  if (!fit) {
    return fit.error();
  }
  const auto feet = rod.feet(fit->parameters);
  const double rms_m = stroke_rms_m(feet, radius_m);
  if (rms_m > rules.most_rms_m) {
    return Error{printed("stroke lies %s off the rod (rms), limit %.1f mm",
                         in_mm_outside(rms_m, 0.0, rules.most_rms_m).c_str(),
                         rules.most_rms_m * 1e3)};
  }
  const MeasuredBend found = bend_of(rod, *fit, rms_m);
  if (const Status s = check_reach(feet, found.arc, arcs.size(), rules); !s) {
    return s.error();
  }
  return found;
}

}  // namespace orthonav::nav
