#include "nav/tracking/pivot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <limits>

#include "base/angle.h"
#include "base/findings.h"
#include "base/joined.h"
#include "base/printed.h"
#include "base/random.h"
#include "nav/geometry/matrix_as.h"
#include "nav/statistics/consensus.h"

namespace orthonav::nav {
namespace {

using Poses = std::span<const Transform<World, Marker>>;
using Chosen = std::span<const std::size_t>;

// So small a rotation does not determine the tip.
constexpr double kLeastSpreadRad = 1e-6;

struct Means {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

Means means_of(Poses poses, Chosen chosen) {
  Means mean;
  for (const std::size_t i : chosen) {
    mean.rotation += matrix_as<Eigen::Matrix3d>(poses[i].rotation());
    mean.translation += vector_as<Eigen::Vector3d>(poses[i].translation());
  }
  mean.rotation /= static_cast<double>(chosen.size());
  mean.translation /= static_cast<double>(chosen.size());
  return mean;
}

}  // namespace

std::optional<PivotFit> fit_pivot(Poses poses, Chosen chosen) {
  if (chosen.size() < 3) {
    return std::nullopt;
  }
  const auto count = static_cast<double>(chosen.size());
  const Means mean = means_of(poses, chosen);
  if (!mean.rotation.allFinite() || !mean.translation.allFinite()) {
    return std::nullopt;
  }
  // The pivot is the mean of R·tip + t; without it, (R - mean R)·tip = -(t - mean t).
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const std::size_t i : chosen) {
    const Eigen::Matrix3d deviation =
        matrix_as<Eigen::Matrix3d>(poses[i].rotation()) - mean.rotation;
    normal += deviation.transpose() * deviation;
    right -= deviation.transpose() *
             (vector_as<Eigen::Vector3d>(poses[i].translation()) - mean.translation);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normal);
  PivotFit fit;
  fit.spread_rad = std::sqrt(std::max(0.0, solver.eigenvalues()(0)) / count);
  if (!(fit.spread_rad > kLeastSpreadRad)) {
    return std::nullopt;
  }
  const Eigen::Vector3d inverse = solver.eigenvalues().cwiseInverse();
  const Eigen::Vector3d tip =
      solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose() * right;
  fit.tip_in_marker = {vec_of(tip)};
  fit.pivot_in_world = {vec_of(Eigen::Vector3d(mean.rotation * tip + mean.translation))};
  double squared = 0.0;
  for (const std::size_t i : chosen) {
    squared += fit.miss_m(poses[i]) * fit.miss_m(poses[i]);
  }
  fit.rmse_m = std::sqrt(squared / count);
  return fit;
}

namespace {

constexpr double kEighth = 8.0;
constexpr int kTimes = 8;
constexpr std::array kWhiteShares = {0.0, 0.1, 0.25, 0.5, 0.75};

// Of one pose: its equations for tip and pivot, and what they leave.
using Rows = Eigen::Matrix<double, 3, 7>;
using Gram = Eigen::Matrix<double, 7, 7>;

/// Correlation of the errors of two poses n apart: (1 - white) exp(-n / time), and 1 for n = 0.
struct Noise {
  double time = 0.0;
  double white = 1.0;

  [[nodiscard]] double decay(double apart) const {
    return time > 0.0 ? std::exp(-apart / time) : 0.0;
  }
};

struct Equations {
  std::vector<Rows> rows;
  std::vector<double> apart;  ///< from the pose before
};

Equations equations_of(Poses poses, Chosen chosen, const PivotFit& fit) {
  const Eigen::Matrix3d mean = means_of(poses, chosen).rotation;
  Equations out;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const auto& pose = poses[chosen[k]];
    const Vec3 left = pose * fit.tip_in_marker - fit.pivot_in_world;
    Rows rows;
    rows << matrix_as<Eigen::Matrix3d>(pose.rotation()) - mean, -Eigen::Matrix3d::Identity(),
        vector_as<Eigen::Vector3d>(left);
    out.rows.push_back(rows);
    out.apart.push_back(k > 0 ? static_cast<double>(chosen[k] - chosen[k - 1]) : 0.0);
  }
  return out;
}

/// Logarithm of the restricted likelihood, but for a constant. A Kalman filter of the correlated
/// part whitens the equations.
double likelihood(const Equations& equations, const Noise& noise) {
  Rows predicted = Rows::Zero();
  double variance = 1.0 - noise.white;
  double log_variances = 0.0;
  Gram gram = Gram::Zero();
  for (std::size_t i = 0; i < equations.rows.size(); ++i) {
    if (i > 0) {
      const double decay = noise.decay(equations.apart[i]);
      predicted *= decay;
      variance = decay * decay * variance + (1.0 - decay * decay) * (1.0 - noise.white);
    }
    const double total = variance + noise.white;
    const Rows surprise = equations.rows[i] - predicted;
    gram += surprise.transpose() * surprise / total;
    log_variances += 3.0 * std::log(total);
    predicted += variance / total * surprise;
    variance *= noise.white / total;
  }
  const Eigen::LLT<Eigen::Matrix<double, 6, 6>> normal(gram.topLeftCorner<6, 6>());
  const Eigen::Matrix<double, 6, 1> right = gram.topRightCorner<6, 1>();
  const double squares =
      std::max(gram(6, 6) - right.dot(normal.solve(right)), std::numeric_limits<double>::min());
  const double freedom = 3.0 * static_cast<double>(equations.rows.size()) - 6.0;
  const double log_normal = 2.0 * normal.matrixLLT().diagonal().array().log().sum();
  return -0.5 * (freedom * std::log(squares) + log_variances + log_normal);
}

Noise likeliest(const Equations& equations) {
  Noise best;
  double highest = likelihood(equations, best);
  const double longest = static_cast<double>(equations.rows.size()) / kEighth;
  for (int step = 0; step < kTimes && longest > 1.0; ++step) {
    for (const double white : kWhiteShares) {
      const Noise noise{std::pow(longest, step / (kTimes - 1.0)), white};
      if (const double now = likelihood(equations, noise); now > highest) {
        highest = now;
        best = noise;
      }
    }
  }
  return best;
}

}  // namespace

double TipUncertainty::sigma_m() const {
  return std::sqrt(covariance_m2[0][0] + covariance_m2[1][1] + covariance_m2[2][2]);
}

TipUncertainty tip_uncertainty(std::span<const Transform<World, Marker>> poses,
                               std::span<const std::size_t> chosen, const PivotFit& fit) {
  const Equations equations = equations_of(poses, chosen, fit);
  const Noise noise = likeliest(equations);
  // Sums over all pairs of poses, each with its correlation.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d pairs = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d before = Eigen::Matrix3d::Zero();
  double squares = 0.0;
  double pair_sum = 0.0;
  double before_sum = 0.0;
  for (std::size_t i = 0; i < equations.rows.size(); ++i) {
    const Eigen::Matrix3d deviation = equations.rows[i].leftCols<3>();
    const double decay = i > 0 ? noise.decay(equations.apart[i]) : 0.0;
    before *= decay;
    before_sum *= decay;
    const Eigen::Matrix3d own = deviation.transpose() * deviation;
    const Eigen::Matrix3d shared = (1.0 - noise.white) * deviation.transpose() * before;
    normal += own;
    pairs += own + shared + shared.transpose();
    pair_sum += 1.0 + 2.0 * (1.0 - noise.white) * before_sum;
    before += deviation;
    before_sum += 1.0;
    squares += equations.rows[i].col(6).squaredNorm();
  }
  const auto count = static_cast<double>(equations.rows.size());
  const Eigen::Matrix3d inverse = normal.inverse();
  // The fit takes some of the noise out of the residuals, and the more the more it is correlated.
  const double freedom = 3.0 * count - 3.0 * pair_sum / count - (inverse * pairs).trace();
  const Eigen::Matrix3d covariance = squares / freedom * inverse * pairs * inverse;
  TipUncertainty out;
  out.covariance_m2 = mat_of(covariance);
  out.independent_poses = count * count / pair_sum;
  return out;
}

namespace {

using PivotConsensus = Consensus<PivotFit>;

/// Limits beyond which a result gets a note.
constexpr double kPivotNoteSpread_rad = 0.25;
constexpr double kPivotNoteTipSigma_m = 0.0003;
constexpr double kPivotNoteInlierFraction = 0.9;
constexpr std::size_t kSampleSize = 3;
// Half of the tips that scatter normally with SD s in each direction lie within 1.538 s.
constexpr double kMedianOfMaxwell = 1.538;
// Below this, differences are rounding.
constexpr double kLeastInlierM = 1e-4;

Error refused(const char* format, double value, double limit) {
  return Error{"pivot calibration: " + with_numbers(format, value, limit)};
}

/// Three different poses that determine the tip: neighbours in time hardly turn.
std::optional<PivotFit> sampled(Poses poses, double least_spread_rad, Random& random) {
  std::array<std::size_t, kSampleSize> sample{};
  for (std::size_t& index : sample) {
    index = static_cast<std::size_t>(random.uniform() * static_cast<double>(poses.size()));
  }
  if (sample[0] == sample[1] || sample[0] == sample[2] || sample[1] == sample[2]) {
    return std::nullopt;
  }
  const auto fit = fit_pivot(poses, sample);
  return fit && fit->spread_rad >= least_spread_rad ? fit : std::nullopt;
}

PivotConsensus consensus_of(Poses poses, const PivotOptions& options) {
  return {poses.size(),
          [poses](std::span<const std::size_t> chosen) { return fit_pivot(poses, chosen); },
          [poses](const PivotFit& fit, std::size_t i) { return fit.miss_m(poses[i]); },
          [poses, least_rad = 0.5 * options.min_spread_rad](Random& random) {
            return sampled(poses, least_rad, random);
          },
          options.inlier_m,
          kLeastInlierM,
          kMedianOfMaxwell};
}

double jackknife_sigma_m(const PivotConsensus& consensus, const PivotConsensus::Indices& inliers) {
  std::vector<Vec3> tips;
  for (const PivotFit& fit : consensus.without_each_block(inliers)) {
    tips.push_back(fit.tip_in_marker.v);
  }
  return jackknife_sd(tips);
}

void add_uncertainty(const TipUncertainty& uncertainty, PivotCalibration& found) {
  const double sigma_m = uncertainty.sigma_m();
  found.tip_sigma_m = std::max(sigma_m, found.leave_out_m);
  found.tip_covariance_m2 = uncertainty.covariance_m2;
  found.independent_poses = uncertainty.independent_poses;
  if (found.leave_out_m > sigma_m && sigma_m > 0.0) {
    const double grown = found.leave_out_m / sigma_m;
    for (auto& row : found.tip_covariance_m2.m) {
      for (double& entry : row) {
        entry *= grown * grown;
      }
    }
  }
}

Status check_poses(Poses poses, const PivotOptions& options) {
  if (const auto problems = options.check(); !problems.empty()) {
    return Error{"pivot calibration: " + joined(problems)};
  }
  if (poses.size() < options.min_poses) {
    return refused("%.0f poses, at least %.0f are needed", static_cast<double>(poses.size()),
                   static_cast<double>(options.min_poses));
  }
  for (const auto& pose : poses) {
    for (const double number : pose.row_major()) {
      if (!std::isfinite(number)) {
        return Error{"pivot calibration: a pose is not finite"};
      }
    }
  }
  return {};
}

Status check_result(const PivotCalibration& found, const PivotOptions& options) {
  const double fraction = static_cast<double>(found.inliers) / static_cast<double>(found.poses);
  if (!(found.spread_rad >= options.min_spread_rad)) {
    return refused("the tool turned by %.1f° RMS, at least %.1f° is needed",
                   degrees(found.spread_rad), degrees(options.min_spread_rad));
  }
  if (!(fraction >= options.min_inlier_fraction) || found.inliers < options.min_poses) {
    return refused(
        "%.0f %% of the poses agree on a pivot, at least %.0f %% are needed "
        "(did the tip slip?)",
        100.0 * fraction, 100.0 * options.min_inlier_fraction);
  }
  if (!(found.rmse_m <= options.max_rmse_m)) {
    return refused("residual %.2f mm RMS, limit %.2f mm (did the tip slip?)", found.rmse_m * 1e3,
                   options.max_rmse_m * 1e3);
  }
  if (!(found.tip_sigma_m <= options.max_tip_sigma_m)) {
    return refused("the tip is known to %.2f mm, limit %.2f mm (turn it further, for longer)",
                   found.tip_sigma_m * 1e3, options.max_tip_sigma_m * 1e3);
  }
  return {};
}

Judgement judged(const PivotCalibration& found) {
  Judgement judgement;
  const double fraction = static_cast<double>(found.inliers) / static_cast<double>(found.poses);
  if (found.spread_rad < kPivotNoteSpread_rad) {
    judgement.add(Verdict::kNote, with_numbers("turned by %.1f° RMS only, better %.1f°",
                                               found.spread_rad * kDegreesPerRadian,
                                               kPivotNoteSpread_rad * kDegreesPerRadian));
  }
  if (found.tip_sigma_m > kPivotNoteTipSigma_m) {
    judgement.add(Verdict::kNote,
                  with_numbers("the tip is known to %.2f mm only, better %.2f mm",
                               found.tip_sigma_m * 1e3, kPivotNoteTipSigma_m * 1e3));
  }
  if (fraction < kPivotNoteInlierFraction) {
    judgement.add(Verdict::kNote, with_numbers("%.0f %% of the poses agree, better %.0f %%",
                                               100.0 * fraction, 100.0 * kPivotNoteInlierFraction));
  }
  judgement.conclude();
  return judgement;
}

}  // namespace

std::vector<std::string> PivotOptions::check() const {
  std::vector<std::string> problems;
  if (min_poses < kSampleSize) {
    problems.push_back("min_poses " + std::to_string(min_poses) + ", must be at least " +
                       std::to_string(kSampleSize));
  }
  must_be_positive(
      {
          {"min_spread_rad", min_spread_rad},
          {"max_rmse_m", max_rmse_m},
          {"inlier_m", inlier_m},
          {"max_tip_sigma_m", max_tip_sigma_m},
      },
      problems);
  must_be_fractions(
      {
          {"min_inlier_fraction", min_inlier_fraction},
      },
      problems);
  if (rounds < 1) {
    problems.push_back("rounds " + std::to_string(rounds) + ", must be at least 1");
  }
  return problems;
}

Result<PivotCalibration> pivot_calibration(Poses poses, const PivotOptions& options) {
  if (Status status = check_poses(poses, options); !status) {
    return status.error();
  }
  const PivotConsensus consensus = consensus_of(poses, options);
  Random random(options.seed);
  std::optional<PivotFit> fit = consensus.best(options.rounds, random);
  if (!fit) {
    return refused("the tool turned by %.1f° RMS, at least %.1f° is needed", 0.0,
                   degrees(options.min_spread_rad));
  }
  const auto inliers = consensus.settle(*fit);
  PivotCalibration found;
  found.tip_in_marker = fit->tip_in_marker;
  found.pivot_in_world = fit->pivot_in_world;
  found.rmse_m = fit->rmse_m;
  found.spread_rad = fit->spread_rad;
  found.poses = poses.size();
  found.inliers = inliers.size();
  found.inlier.assign(poses.size(), false);
  for (const std::size_t i : inliers) {
    found.inlier[i] = true;
  }
  found.leave_out_m =
      inliers.size() > kJackknifeBlocks ? jackknife_sigma_m(consensus, inliers) : 0.0;
  add_uncertainty(tip_uncertainty(poses, inliers, *fit), found);
  if (Status status = check_result(found, options); !status) {
    return status.error();
  }
  found.judgement = judged(found);
  return found;
}

}  // namespace orthonav::nav
