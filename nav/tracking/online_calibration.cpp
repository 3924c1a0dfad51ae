#include "nav/tracking/online_calibration.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <limits>
#include <utility>

namespace orthonav::nav {
namespace {

/// Errors are correlated from pair to pair: only this fraction of a pair's information is new.
constexpr double kIndependentFraction = 0.05;
/// Two pictures of one moment contradict each other this much in one of a million pairs. Tags
/// of a wrong size are another fault, so for this the sizes' prior is that of all printers.
constexpr double kChance = 1e-6;
constexpr double kAnySizeSd = 0.05;
/// A correction is applied if it turns the camera by more than this, a twentieth of a pixel, or
/// changes a tag's size by more than this.
constexpr double kMinRotation_rad = 0.00015;
constexpr double kMinSize = 0.0004;
/// A larger rotation means that the device is damaged or the calibration belongs to another one;
/// tags whose size is off by more were printed at the wrong scale. Neither is corrected; a wrong
/// tag size is reported instead.
constexpr double kMaxRotation_rad = 0.01;
constexpr double kMaxSize = 0.015;
/// The error that every measured size may share: from the lens, from the light. The cameras' own,
/// 0.6 px across the epipolar lines, as in one real unit, looks like 0.8 % at arm's length.
constexpr double kLeastSizeSd = 0.005;
/// SDs that make a wrong size certain.
constexpr double kCertainSd = 5.0;
constexpr int kCameras = kCameraUnknowns;
using CamerasMatrix = Eigen::Matrix<double, kCameras, kCameras>;
using CamerasVector = Eigen::Matrix<double, kCameras, 1>;
using PairMatrix = Eigen::Matrix<double, kCalibrationUnknowns, kCalibrationUnknowns>;

double precision(double sd) { return 1.0 / (sd * sd); }

/// The probability of a larger chi-square with an even number of degrees of freedom.
double by_chance(double chi_square, int degrees) {
  const double half = 0.5 * std::max(chi_square, 0.0);
  double term = std::exp(-half);
  double sum = term;
  for (int k = 1; k < degrees / 2; ++k) {
    term *= half / k;
    sum += term;
  }
  return sum;
}

}  // namespace

/// The remaining correction, with the sizes eliminated.
struct OnlineCalibration::Estimate {
  CamerasVector cameras;
  CamerasMatrix covariance;
  double gain = 0.0;  ///< by which the squared, normalised error falls
};

OnlineCalibration::OnlineCalibration(std::size_t tools, const CalibrationOptions& options)
    : options_(options), tools_(tools), kept_(tools) {}

void OnlineCalibration::add(std::size_t tool, const CalibrationEquations& pair) {
  const Eigen::Map<const PairMatrix> information(pair.information.data());
  const Eigen::Map<const Eigen::Matrix<double, kCalibrationUnknowns, 1>> right(pair.right.data());
  if (!information.allFinite() || !right.allFinite()) {
    return;
  }
  const double fraction = kIndependentFraction;
  Eigen::Map<CamerasMatrix>(information_.data()) +=
      fraction * information.topLeftCorner<kCameras, kCameras>();
  Eigen::Map<CamerasVector>(right_.data()) += fraction * right.head<kCameras>();
  Tool& t = tools_.at(tool);
  Eigen::Map<CamerasVector>(t.cross.data()) += fraction * information.topRightCorner<kCameras, 1>();
  t.information += fraction * information(kTagSizeUnknown, kTagSizeUnknown);
  t.right += fraction * right(kTagSizeUnknown);
  ++pairs_;
  const double of_size = information(kTagSizeUnknown, kTagSizeUnknown);
  if (of_size > 0.0) {
    const double sd = std::max(1.0 / std::sqrt(of_size), kLeastSizeSd);
    add_size(tool, std::expm1(right(kTagSizeUnknown) / of_size), sd / std::sqrt(fraction));
  }
}

void OnlineCalibration::add_size(std::size_t tool, double fraction, double sd) {
  const double weight = precision(sd);
  if (!std::isfinite(weight * fraction)) {
    return;
  }
  Tool& t = tools_.at(tool);
  t.size_information += weight;
  t.size_sum += weight * fraction;
  ++t.sizes;
}

std::optional<TagSize> OnlineCalibration::tag_size(std::size_t tool) const {
  const Tool& t = tools_.at(tool);
  if (t.sizes == 0) {
    return std::nullopt;
  }
  TagSize out;
  const double left = t.size_sum / t.size_information;
  out.sd = std::sqrt(1.0 / t.size_information);
  out.measurements = t.sizes;
  out.notable = std::abs(left) > kMaxSize;
  out.disagrees = out.notable && std::abs(left) > kCertainSd * out.sd;
  out.applied = size_factor(tool) - 1.0;
  out.fraction = left + out.applied;
  return out;
}

bool OnlineCalibration::may_be_of_wrong_size() const {
  return std::any_of(tools_.begin(), tools_.end(), [](const Tool& t) {
    return std::abs(t.size_sum) > kMaxSize * t.size_information;
  });
}

double OnlineCalibration::size_change(const Tool& tool, const Camera& cameras) const {
  const Eigen::Map<const CamerasVector> cross(tool.cross.data());
  const Eigen::Map<const CamerasVector> x(cameras.data());
  const double prior = precision(options_.size_sd);
  return (tool.right - prior * tool.applied - cross.dot(x)) / (tool.information + prior);
}

void OnlineCalibration::restart() {
  information_ = {};
  right_ = {};
  for (Tool& tool : tools_) {
    tool = Tool{.applied = tool.applied};
  }
  pairs_ = 0;
}

bool OnlineCalibration::explains(std::span<const ToolEquations> pair) {
  double contradiction = 0.0;
  int tags = 0;
  const Priors priors{precision(kMaxRotation_rad), kAnySizeSd};
  const auto before = estimate(priors);
  // The pair is added for the moment; copying keeps the memory.
  const auto information = information_;
  const auto right = right_;
  const std::int64_t pairs = pairs_;
  kept_ = tools_;
  for (const auto& [tool, equations] : pair) {
    contradiction += kIndependentFraction * equations.contradiction;
    tags += equations.tags;
    add(tool, equations);
  }
  const auto after = estimate(priors);
  information_ = information;
  right_ = right;
  pairs_ = pairs;
  std::swap(tools_, kept_);
  if (tags == 0 || !before || !after) {
    return true;
  }
  return by_chance(contradiction - (after->gain - before->gain), 6 * tags) >= kChance;
}

std::optional<OnlineCalibration::Estimate> OnlineCalibration::estimate() const {
  return pairs_ == 0 ? std::nullopt : estimate({0.0, options_.size_sd});
}

std::optional<OnlineCalibration::Estimate> OnlineCalibration::estimate(const Priors& priors) const {
  CamerasMatrix information = Eigen::Map<const CamerasMatrix>(information_.data());
  CamerasVector right = Eigen::Map<const CamerasVector>(right_.data());
  information.topLeftCorner<3, 3>().diagonal().array() += priors.rotation_precision;
  information(kFocalUnknown, kFocalUnknown) += precision(options_.focal_sd);
  information(kBaselineUnknown, kBaselineUnknown) += precision(options_.baseline_sd);
  const double prior = precision(priors.size_sd);
  double gain = 0.0;
  for (const Tool& tool : tools_) {
    const Eigen::Map<const CamerasVector> cross(tool.cross.data());
    const double own = tool.information + prior;
    const double own_right = tool.right - prior * tool.applied;
    information -= cross * cross.transpose() / own;
    right -= cross * (own_right / own);
    gain += own_right * own_right / own;
  }
  const Eigen::LLT<CamerasMatrix> solver(information);
  Estimate out;
  out.cameras = solver.solve(right);
  out.covariance = solver.solve(CamerasMatrix::Identity());
  out.gain = gain + right.dot(out.cameras);
  if (solver.info() != Eigen::Success || !out.cameras.allFinite() || !out.covariance.allFinite()) {
    return std::nullopt;
  }
  return out;
}

bool OnlineCalibration::correct() {
  if (pairs_ < options_.min_pairs) {
    return false;
  }
  const auto found = estimate();
  if (!found || !(found->gain > options_.significance)) {
    return false;
  }
  Camera cameras{};
  Eigen::Map<CamerasVector>(cameras.data()) = found->cameras;
  const Vec3 rotation_rad{cameras[0], cameras[1], cameras[2]};
  bool matters = rotation_rad.norm() > kMinRotation_rad;
  for (const Tool& tool : tools_) {
    const double change = size_change(tool, cameras);
    matters = matters || std::abs(change) > kMinSize;
    if (!(std::abs(tool.applied + change) < kMaxSize)) {
      return false;
    }
  }
  if (!matters || !((applied_rad_ + rotation_rad).norm() < kMaxRotation_rad)) {
    return false;
  }
  apply(cameras);
  return true;
}

/// From now on the equations describe the remaining correction. Focal length and baseline stay as
/// reported.
void OnlineCalibration::apply(const Camera& cameras) {
  CamerasVector x = CamerasVector::Zero();
  x.head<3>() << cameras[0], cameras[1], cameras[2];
  Eigen::Map<CamerasVector> right(right_.data());
  right -= Eigen::Map<const CamerasMatrix>(information_.data()) * x;
  for (Tool& tool : tools_) {
    const double change = size_change(tool, cameras);
    const Eigen::Map<const CamerasVector> cross(tool.cross.data());
    right -= change * cross;
    tool.right -= tool.information * change + cross.dot(x);
    tool.applied += change;
    tool.size_information = tool.size_sum = 0.0;
    tool.sizes = 0;
  }
  rotation_rad_ = {cameras[0], cameras[1], cameras[2]};
  applied_rad_ = applied_rad_ + rotation_rad_;
  applied_ = true;
}

double OnlineCalibration::size_factor(std::size_t tool) const {
  return std::exp(tools_.at(tool).applied);
}

double OnlineCalibration::size_difference_sd(std::size_t tool, std::size_t other) const {
  const double prior = precision(options_.size_sd);
  const Tool& a = tools_.at(tool);
  const Tool& b = tools_.at(other);
  const double own_a = a.information + prior;
  const double own_b = b.information + prior;
  const auto found = tool == other ? std::nullopt : estimate();
  if (!found) {
    return tool == other ? 0.0 : std::sqrt(2.0) * options_.size_sd;
  }
  const CamerasVector apart = Eigen::Map<const CamerasVector>(a.cross.data()) / own_a -
                              Eigen::Map<const CamerasVector>(b.cross.data()) / own_b;
  return std::sqrt(1.0 / own_a + 1.0 / own_b + apart.dot(found->covariance * apart));
}

std::optional<StereoAlignment> OnlineCalibration::alignment() const {
  const auto found = estimate();
  if (!found) {
    return std::nullopt;
  }
  const CamerasVector& x = found->cameras;
  const CamerasVector sd = found->covariance.diagonal().cwiseSqrt();
  StereoAlignment out;
  out.rotation_rad = applied_rad_ + Vec3{x(0), x(1), x(2)};
  out.sd_rad = {sd(0), sd(1), sd(2)};
  out.pairs = pairs_;
  out.within_bounds = out.rotation_rad.norm() <= kMaxRotation_rad;
  out.applied = applied_;
  out.significant =
      applied_ || (pairs_ >= options_.min_pairs && found->gain > options_.significance);
  out.focal_fraction = x(kFocalUnknown);
  out.focal_sd = sd(kFocalUnknown);
  out.baseline_fraction = x(kBaselineUnknown);
  out.baseline_sd = sd(kBaselineUnknown);
  return out;
}

}  // namespace orthonav::nav
