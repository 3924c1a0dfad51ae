#include "nav/tracking/pivot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/angle.h"
#include "base/findings.h"
#include "base/joined.h"
#include "base/printed.h"
#include "base/random.h"
#include "nav/statistics/consensus.h"
#include "nav/tracking/pivot_fit.h"
#include "nav/tracking/tip_uncertainty.h"

namespace orthonav::nav {
namespace {

using Poses = std::span<const Transform<World, Marker>>;
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
