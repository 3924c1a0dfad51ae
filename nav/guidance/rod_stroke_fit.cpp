#include "nav/guidance/rod_stroke_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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

StrokeFoot stroke_foot(const std::vector<Vec3>& chain_m, Vec3 at_m) {
  StrokeFoot nearest;
  double before_m = 0.0;
  for (std::size_t i = 0; i + 1 < chain_m.size(); ++i) {
    const Vec3 chord_m = chain_m[i + 1] - chain_m[i];
    const double length_m = chord_m.norm();
    if (length_m > 0.0) {
      const double along_m = std::clamp((at_m - chain_m[i]).dot(chord_m) / length_m, 0.0, length_m);
      const Vec3 off_m = at_m - chain_m[i] - (along_m / length_m) * chord_m;
      const double distance_m = off_m.norm();
      if (distance_m < nearest.distance_m) {
        nearest = {distance_m, before_m + along_m, off_m};
      }
    }
    before_m += length_m;
  }
  return nearest;
}

/// A rod that was stroked, with its pose and its last bend, if it has one, as parameters: turn and
/// shift of the pose, then the bend's angle and roll.
class StrokedRod {
 public:
  StrokedRod(const RodStrokeTask& task, const RodStrokeRules& rules)
      : arcs_(task.arcs.begin(), task.arcs.end()),
        length_m_(task.length_m),
        radius_m_(task.radius_m),
        points_m_(task.points_m),
        rules_(rules),
        tip_sd_m_(rules.tip_sd_m),
        start_(task.points_from_rod) {}

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
    if (!arcs.empty()) {
      arcs.back() = bend(p);
    }
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
    if (!arcs_.empty()) {
      out.push_back((p[kStrokeAngle] - arcs_.back().angle_rad) / rules_.angle_sd_rad);
      out.push_back((p[kStrokeRoll] - arcs_.back().roll_rad) / rules_.roll_sd_rad);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      out.push_back(p[i] / kPoseRotationSd_rad);
      out.push_back((p[i + 3] - middle_m_[static_cast<int>(i)]) / kPoseTranslationSd_m);
    }
  }
  /// Parameters with the rod's first end at a place, and the bend as instructed.
  [[nodiscard]] std::vector<double> start_at(Vec3 at_m) const {
    std::vector<double> start = {0.0, 0.0, 0.0, at_m.x, at_m.y, at_m.z};
    if (!arcs_.empty()) {
      start.insert(start.end(), {arcs_.back().angle_rad, arcs_.back().roll_rad});
    }
    return start;
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
  Mat3 start_;
  Vec3 middle_m_;
};

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

double one_sided(const std::vector<StrokeFoot>& feet) {
  Vec3 sum;
  for (const StrokeFoot& foot : feet) {
    sum += foot.distance_m > 0.0 ? foot.off_m / foot.distance_m : Vec3{};
  }
  return sum.norm() / static_cast<double>(feet.size());
}

/// Starts with the axis through the points, and with it shifted to the four sides, since only one
/// side may have been stroked.
Result<LeastSquares> first_fit(StrokedRod& rod, const RodStrokeTask& task) {
  const Vec3 x = task.radius_m * task.points_from_rod.column(0);
  const Vec3 y = task.radius_m * task.points_from_rod.column(1);
  const std::array<Vec3, 5> offsets_m = {Vec3{}, x, -x, y, -y};
  Result<LeastSquares> best = Error{"stroke of the rod can't be fitted"};
  for (const Vec3& offset_m : offsets_m) {
    auto fit = rod.fitted(rod.start_at(task.rod_in_points_m + offset_m), kFirstIterations);
    if (fit && (!best || fit->sum_of_squares < best->sum_of_squares)) {
      best = std::move(fit);
    }
  }
  return best;
}

/// Fits to convergence before the points' errors are judged, since a misfit would be taken for a
/// common error; then fits again with those errors.
Result<LeastSquares> settled_fit(StrokedRod& rod, const RodStrokeTask& task,
                                 const RodStrokeRules& rules) {
  auto fit = first_fit(rod, task);
  if (!fit) {
    return fit;
  }
  fit = rod.fitted(std::vector<double>(fit->parameters), kAllIterations);
  if (!fit) {
    return fit;
  }
  const auto feet = rod.feet(fit->parameters);
  rod.set_tip_sd_m(std::max(
      rules.tip_sd_m,
      stroke_rms_m(feet, task.radius_m) * std::sqrt(common_error_factor(feet, task.radius_m))));
  return rod.fitted(std::vector<double>(fit->parameters), kAllIterations);
}

MeasuredBend bend_of(const StrokedRod& rod, const LeastSquares& fit, bool straight, double rms_m) {
  const std::vector<double>& p = fit.parameters;
  MeasuredBend found{
      .rms_m = rms_m, .points_from_rod = rod.rotation(p), .rod_in_points_m = {p[3], p[4], p[5]}};
  if (!straight) {
    const std::size_t n = p.size();
    found.arc = rod.bend(p);
    found.angle_se_rad = std::sqrt(fit.covariance[kStrokeAngle * n + kStrokeAngle]);
    found.roll_se_rad = std::sqrt(fit.covariance[kStrokeRoll * n + kStrokeRoll]);
  }
  return found;
}

}  // namespace

Result<RodStrokeFit> fit_rod_stroke(const RodStrokeTask& task, const RodStrokeRules& rules) {
  StrokedRod rod(task, rules);
  const auto fit = settled_fit(rod, task, rules);
  if (!fit) {
    return fit.error();
  }
  RodStrokeFit out;
  out.feet = rod.feet(fit->parameters);
  out.rod = bend_of(rod, *fit, task.arcs.empty(), stroke_rms_m(out.feet, task.radius_m));
  out.rod.one_sided = one_sided(out.feet);
  return out;
}

}  // namespace orthonav::nav
