#include "nav/registration/fit_covariance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <map>
#include <vector>

#include "nav/tracking/symmetric_covariance.h"

namespace orthonav::nav {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
/// Pose and standoff.
using Matrix7 = Eigen::Matrix<double, 7, 7>;
using Vector7 = Eigen::Matrix<double, 7, 1>;

/// A larger step between two points begins another stroke.
constexpr double kLeap_m = 0.008;
/// Noise of a hand and a tracker is uncorrelated after this many points: 2 s at 30 Hz.
constexpr std::size_t kLongestLag = 60;
/// The autocorrelation is followed until it falls below this; smaller values drown in chance, and
/// the fit has absorbed part of them. Beyond, it is extrapolated at the rate at which it fell.
constexpr double kNoiseCorrelation = 0.12;
constexpr double kNegligibleCorrelation = 0.01;
/// From one point to the next, the extrapolated correlation falls at least by this factor.
constexpr double kSlowest = 0.97;
/// Variance in addition to what the residuals show: measured (docs/registration.md).
constexpr double kUnseen = 1.15;
constexpr double kCell_m = 0.005;
/// Rotations are compared with translations at this lever arm.
constexpr double kLever_m = 0.03;
/// The least visible motion may be this much less visible than the most visible one.
constexpr double kWeakest = 1e-6;

Vector7 derivative(const FittedPoint& p, bool with_standoff) {
  const Vec3 by_rotation = p.lever_arm_m.cross(p.gradient);
  Vector7 j;
  j << p.gradient.x, p.gradient.y, p.gradient.z, by_rotation.x, by_rotation.y, by_rotation.z,
      with_standoff ? -1.0 : 0.0;
  return j;
}

double influence(const FittedPoint& p) { return p.weight * p.residual_m; }

/// The number of each point's stroke; `ordered` is false when most steps are leaps.
struct Strokes {
  std::vector<int> of;
  bool ordered = true;
};

Strokes strokes_of(const SurfaceFit& fit) {
  Strokes out;
  int stroke = 0;
  std::size_t leaps = 0;
  for (std::size_t i = 0; i < fit.points.size(); ++i) {
    if (i > 0 && (fit.points[i].lever_arm_m - fit.points[i - 1].lever_arm_m).norm() > kLeap_m) {
      ++stroke;
      ++leaps;
    }
    out.of.push_back(stroke);
  }
  out.ordered = 2 * leaps < fit.points.size();
  return out;
}

/// Autocovariance of the influences along strokes, from lag 0 on, as far as they are correlated.
std::vector<double> autocovariance(const SurfaceFit& fit, const std::vector<int>& stroke) {
  std::vector<double> out;
  const std::size_t n = fit.points.size();
  for (std::size_t lag = 0; lag < std::min(kLongestLag, n); ++lag) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i + lag < n; ++i) {
      const FittedPoint& a = fit.points[i];
      const FittedPoint& b = fit.points[i + lag];
      if (stroke[i] != stroke[i + lag] || !(a.weight > 0.0) || !(b.weight > 0.0)) {
        continue;
      }
      sum += influence(a) * influence(b);
      count += 1.0;
    }
    const double value = count > 0.0 ? sum / count : 0.0;
    if (lag > 0 && (count < 10.0 || value < kNoiseCorrelation * out[0])) {
      break;
    }
    out.push_back(value);
  }
  if (out.size() < 3) {
    return out;
  }
  const double falls =
      std::min(kSlowest, std::pow(out.back() / out[1], 1.0 / static_cast<double>(out.size() - 2)));
  while (out.size() < kLongestLag && out.back() > kNegligibleCorrelation * out[0]) {
    out.push_back(falls * out.back());
  }
  return out;
}

Matrix7 middle_along_strokes(const SurfaceFit& fit, const std::vector<Vector7>& j,
                             const std::vector<int>& stroke, const std::vector<double>& gamma) {
  Matrix7 out = Matrix7::Zero();
  for (std::size_t lag = 0; lag < gamma.size(); ++lag) {
    Matrix7 sum = Matrix7::Zero();
    for (std::size_t i = 0; i + lag < j.size(); ++i) {
      if (stroke[i] == stroke[i + lag] && fit.points[i].weight > 0.0 &&
          fit.points[i + lag].weight > 0.0) {
        sum.noalias() += j[i] * j[i + lag].transpose();
      }
    }
    out += lag == 0 ? Matrix7(gamma[0] * sum) : Matrix7(gamma[lag] * (sum + sum.transpose()));
  }
  return out;
}

/// For points without order: all points of a cell err alike.
Matrix7 middle_by_cells(const SurfaceFit& fit, const std::vector<Vector7>& j, double gamma) {
  std::map<std::array<long, 3>, Vector7> cells;
  for (std::size_t i = 0; i < j.size(); ++i) {
    if (!(fit.points[i].weight > 0.0)) {
      continue;
    }
    const auto cell = [](double x) { return std::lround(x / kCell_m); };
    const Vec3 p = fit.points[i].lever_arm_m;
    cells.try_emplace({cell(p.x), cell(p.y), cell(p.z)}, Vector7::Zero()).first->second += j[i];
  }
  Matrix7 out = Matrix7::Zero();
  for (const auto& [cell, sum] : cells) {
    out += gamma * sum * sum.transpose();
  }
  return out;
}

/// Nothing when a motion is undetermined.
std::optional<Matrix7> inverse_of(const Matrix7& information) {
  Vector7 lever;
  lever << 1, 1, 1, kLever_m, kLever_m, kLever_m, 1;
  const auto scale = lever.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix7> solver(Matrix7(scale * information * scale));
  if (!(solver.eigenvalues()[0] > kWeakest * solver.eigenvalues()[6])) {
    return std::nullopt;
  }
  return Matrix7(scale *
                 (solver.eigenvectors() * solver.eigenvalues().cwiseInverse().asDiagonal() *
                  solver.eigenvectors().transpose()) *
                 scale);
}

/// The fit linearized at its solution.
struct Linearized {
  std::vector<Vector7> j;           ///< of each point
  Matrix7 plain = Matrix7::Zero();  ///< sum of j jᵀ over the points that are used
  double slope = 0.0;               ///< mean derivative of the influence by the residual
  double used = 0.0;
};

Linearized linearized(const SurfaceFit& fit) {
  Linearized out;
  out.j.reserve(fit.points.size());
  if (!fit.with_standoff) {
    out.plain(6, 6) = 1.0;
  }
  for (const FittedPoint& p : fit.points) {
    out.j.push_back(derivative(p, fit.with_standoff));
    if (!(p.weight > 0.0)) {
      continue;
    }
    out.plain += out.j.back() * out.j.back().transpose();
    const double t = std::sqrt(p.weight);  // 1 - (r/c)^2
    out.slope += t * (t - 4.0 * (1.0 - t));
    out.used += 1.0;
  }
  out.slope = std::max(out.slope / out.used, 0.2);
  return out;
}

/// The middle of the sandwich: the covariance of the sum of the points' influences.
struct Middle {
  Matrix7 covariance;
  double variance = 0.0;  ///< of one point's influence
};

Middle middle_of(const SurfaceFit& fit, const Linearized& at) {
  const Strokes strokes = strokes_of(fit);
  if (strokes.ordered) {
    const std::vector<double> gamma = autocovariance(fit, strokes.of);
    return {middle_along_strokes(fit, at.j, strokes.of, gamma), gamma[0]};
  }
  double sum = 0.0;
  for (const FittedPoint& p : fit.points) {
    sum += influence(p) * influence(p);
  }
  const double variance = sum / at.used;
  return {middle_by_cells(fit, at.j, variance), variance};
}

}  // namespace

std::optional<FitCovariance> covariance_of(const SurfaceFit& fit) {
  const Linearized at = linearized(fit);
  if (at.used < 12.0) {
    return std::nullopt;
  }
  const auto inverse = inverse_of(at.plain);
  if (!inverse) {
    return std::nullopt;
  }
  const Middle middle = middle_of(fit, at);
  const double slope2 = at.slope * at.slope;
  const Matrix7 whole = *inverse * middle.covariance * *inverse / slope2;
  Matrix6 covariance = whole.topLeftCorner<6, 6>();
  const Matrix6 independent =
      (*inverse * (middle.variance * at.plain) * *inverse).topLeftCorner<6, 6>() / slope2;
  FitCovariance out;
  const double repeated = std::max(1.0, (covariance * independent.inverse()).trace() / 6.0);
  out.effective_points = at.used / repeated;
  // Six numbers were fitted to the points, and some correlation (between strokes, of outliers that
  // pass) shows in no residual.
  const double more = kUnseen * out.effective_points / std::max(out.effective_points - 6.0, 1.0);
  covariance *= more;
  out.standoff_sd_m = std::sqrt(more * whole(6, 6));
  out.uncertainty = PoseUncertainty(fit.pose.centre_m, symmetrized(covariance));
  return out;
}

}  // namespace orthonav::nav
