#include "nav/registration/height_answers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Core>
#include <numbers>

#include "nav/statistics/symmetric_eigen.h"

namespace orthonav::nav {
namespace {

using Eigen::Index;
using UnknownsVector = Eigen::Matrix<double, kHeightUnknowns, 1>;
using UnknownsMatrix = Eigen::Matrix<double, kHeightUnknowns, kHeightUnknowns>;
using UnknownsRows = Eigen::Matrix<double, kHeightUnknowns, kHeightUnknowns, Eigen::RowMajor>;

struct UnknownsAnswer {
  double log_evidence = 0.0;
  UnknownsVector unknowns = UnknownsVector::Zero();
  UnknownsMatrix covariance = UnknownsMatrix::Zero();
};

constexpr Index kStandoff = kStandoffUnknown;
constexpr Index kSize = kSizeUnknown;
/// Priors: the SD of the mean height, and the SD of the size.
constexpr double kStandoffPrior_m = 0.002;
constexpr double kSizePrior = 0.05;
/// Rotations are compared with translations at this lever arm, the size likewise.
constexpr double kHeightLever_m = 0.03;
/// The least visible motion may be this much less visible than the most visible one.
constexpr double kLeastVisible = 1e-6;

/// The standoff is not negative: the rest of the normal distribution is left out (mean and variance
/// of a truncated normal distribution; the others follow by regression on it).
void leave_out_negative(UnknownsAnswer& a) {
  const double sd = std::sqrt(a.covariance(kStandoff, kStandoff));
  const double t = a.unknowns(kStandoff) / sd;
  const double kept = std::max(0.5 * std::erfc(-t / std::numbers::sqrt2), 1e-12);
  const double density = std::exp(-0.5 * t * t) / std::sqrt(2.0 * std::numbers::pi);
  const double ratio = t < -6.0 ? -t : density / kept;
  const double mean = sd * std::max(t + ratio, 0.0);
  const double variance = sd * sd * std::clamp(1.0 - ratio * (ratio + t), 0.02, 1.0);
  const UnknownsVector slope = a.covariance.col(kStandoff) / (sd * sd);
  a.unknowns += slope * (mean - a.unknowns(kStandoff));
  a.covariance -= (sd * sd - variance) * slope * slope.transpose();
  a.log_evidence += std::log(kept);
}

/// The first `count` unknowns alone, the others being zero.
std::optional<UnknownsAnswer> answer(std::size_t count, const UnknownsMatrix& information,
                                     const UnknownsVector& right, double squares,
                                     double log_determinant, double log_prior) {
  // Right-hand sides: the unit matrix and `right`. Whitened, they give the inverse and the
  // solution.
  WhitenedSystem system;
  system.reset(count, count + 1);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k <= i; ++k) {
      system.covariance(i, k) = information(static_cast<Index>(i), static_cast<Index>(k));
    }
    system.right_side(i, i) = 1.0;
    system.right_side(i, count) = right(static_cast<Index>(i));
  }
  if (!system.whiten()) {
    return std::nullopt;
  }
  UnknownsAnswer out;
  double explained = 0.0;
  const auto n = static_cast<Index>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Map<const Eigen::VectorXd> row(system.right_sides(i), n);
    const double by_right = system.right_sides(i)[count];
    out.unknowns.head(n) += by_right * row;
    out.covariance.topLeftCorner(n, n) += row * row.transpose();
    explained += by_right * by_right;
  }
  out.log_evidence =
      -0.5 * (log_determinant + system.log_determinant() + squares - explained) + log_prior;
  if (!out.unknowns.allFinite() || !std::isfinite(out.log_evidence)) {
    return std::nullopt;
  }
  leave_out_negative(out);
  const auto scales = unknowns_scale();
  const Eigen::Map<const UnknownsVector> scale(scales.data());
  out.unknowns = scale.asDiagonal() * out.unknowns;
  out.covariance = (scale.asDiagonal() * out.covariance * scale.asDiagonal()).eval();
  return out;
}

bool determines_pose(const UnknownsMatrix& information) {
  std::array<double, 36> pose{};
  Eigen::Map<Eigen::Matrix<double, 6, 6>>(pose.data()) = information.topLeftCorner<6, 6>();
  const SymmetricEigen6 eigen = symmetric_eigen(pose);
  return eigen.values[0] > kLeastVisible * eigen.values[5];
}

HeightModel::Answer plain(const UnknownsAnswer& a) {
  HeightModel::Answer out;
  out.log_evidence = a.log_evidence;
  Eigen::Map<UnknownsVector>(out.unknowns.data()) = a.unknowns;
  Eigen::Map<UnknownsRows>(out.covariance.data()) = a.covariance;
  return out;
}

}  // namespace

std::array<double, kHeightUnknowns> unknowns_scale() {
  constexpr double kByLever = 1.0 / kHeightLever_m;
  return {1.0, 1.0, 1.0, kByLever, kByLever, kByLever, 1.0, kByLever};
}

void WhitenedSums::add(const WhitenedSystem& system) {
  Eigen::Map<UnknownsMatrix> all(information.data());
  Eigen::Map<UnknownsVector> sides(right.data());
  for (std::size_t k = 0; k < system.size(); ++k) {
    const double* const row = system.right_sides(k);
    const Eigen::Map<const UnknownsVector> derivative(row);
    const double height = row[kHeightUnknowns];
    all += derivative * derivative.transpose();
    sides += height * derivative;
    squares += height * height;
  }
  log_determinant += system.log_determinant();
}

std::optional<HeightModel::Answers> answers_of(const WhitenedSums& sums) {
  UnknownsMatrix information = Eigen::Map<const UnknownsMatrix>(sums.information.data());
  const UnknownsVector right = Eigen::Map<const UnknownsVector>(sums.right.data());
  if (!information.allFinite() || !determines_pose(information)) {
    return std::nullopt;
  }
  const double size_precision = std::pow(kSizePrior * kHeightLever_m, -2.0);
  information(kStandoff, kStandoff) += 1.0 / (kStandoffPrior_m * kStandoffPrior_m);
  information(kSize, kSize) += size_precision;
  const auto fixed =
      answer(kSizeUnknown, information, right, sums.squares, sums.log_determinant, 0.0);
  const auto free = answer(kHeightUnknowns, information, right, sums.squares, sums.log_determinant,
                           0.5 * std::log(size_precision));
  if (!fixed || !free) {
    return std::nullopt;
  }
  return HeightModel::Answers{plain(*fixed), plain(*free)};
}

}  // namespace orthonav::nav
