#include "nav/tracking/pivot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "base/angle.h"
#include "base/findings.h"
#include "base/joined.h"
#include "base/printed.h"
#include "base/random.h"
#include "nav/statistics/blocked_jackknife.h"
#include "nav/statistics/median.h"
#include "nav/tracking/pivot_fit.h"

namespace orthonav::nav {
namespace {

using Poses = std::span<const Transform<World, Marker>>;
using Indices = std::vector<std::size_t>;

constexpr std::size_t kSampleSize = 3;
// For tips that scatter normally with SD s in each direction, half lie within 1.538 s, and all but
// one in 3000 within 4.5 s.
constexpr double kMedianOfMaxwell = 1.538;
constexpr double kInlierSds = 4.5;
// Below this, differences are rounding.
constexpr double kLeastInlierM = 1e-4;
constexpr int kMostRefits = 20;

Error refused(const char* format, double value, double limit) {
  return Error{"pivot calibration: " + with_numbers(format, value, limit)};
}

Indices all_of(Poses poses) {
  Indices all(poses.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

Indices within(const PivotFit& fit, Poses poses, double limit_m) {
  Indices inliers;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (fit.miss_m(poses[i]) <= limit_m) {
      inliers.push_back(i);
    }
  }
  return inliers;
}

/// Squared misses, each counted up to the limit.
double cost(const PivotFit& fit, Poses poses, double limit_m) {
  double sum = 0.0;
  for (const auto& pose : poses) {
    const double miss_m = std::min(fit.miss_m(pose), limit_m);
    sum += miss_m * miss_m;
  }
  return sum;
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

/// The fit that most poses agree with; the plain one when no sample turns enough.
std::optional<PivotFit> best_fit(Poses poses, const PivotOptions& options) {
  Random random(options.seed);
  std::optional<PivotFit> best = fit_pivot(poses, all_of(poses));
  double best_cost = best ? cost(*best, poses, options.inlier_m) : 0.0;
  for (int round = 0; round < options.rounds; ++round) {
    auto fit = sampled(poses, 0.5 * options.min_spread_rad, random);
    if (!fit) {
      continue;
    }
    // A sample of three amplifies noise: the poses that agree with it locate the pivot better.
    if (const auto again = fit_pivot(poses, within(*fit, poses, 2.0 * options.inlier_m))) {
      fit = again;
    }
    const double fit_cost = cost(*fit, poses, options.inlier_m);
    if (best && fit_cost >= best_cost) {
      continue;
    }
    best = fit;
    best_cost = fit_cost;
  }
  return best;
}

/// The limit for inliers, from the scatter of the poses nearest to the pivot.
double inlier_limit_m(const PivotFit& fit, Poses poses, double most_m) {
  std::vector<double> misses;
  for (const std::size_t i : within(fit, poses, most_m)) {
    misses.push_back(fit.miss_m(poses[i]));
  }
  if (misses.empty()) {
    return most_m;
  }
  return std::clamp(kInlierSds * median(std::move(misses)) / kMedianOfMaxwell, kLeastInlierM,
                    most_m);
}

/// Repeats the fit to the inliers until they no longer change.
Indices settled(Poses poses, double most_m, PivotFit& fit) {
  Indices inliers;
  for (int round = 0; round < kMostRefits; ++round) {
    Indices now = within(fit, poses, inlier_limit_m(fit, poses, most_m));
    const bool same = now == inliers;
    inliers = std::move(now);
    const auto again = fit_pivot(poses, inliers);
    if (same || !again) {
      break;
    }
    fit = *again;
  }
  return inliers;
}

double jackknife_sigma_m(Poses poses, const Indices& inliers) {
  std::vector<Vec3> tips;
  Vec3 mean;
  for (std::size_t block = 0; block < kJackknifeBlocks; ++block) {
    Indices rest = without_block(inliers.size(), block);
    for (std::size_t& i : rest) {
      i = inliers[i];
    }
    const auto fit = fit_pivot(poses, rest);
    if (!fit) {
      continue;
    }
    tips.push_back(fit->tip_in_marker.v);
    mean += fit->tip_in_marker.v;
  }
  if (tips.size() < 2) {
    return 0.0;
  }
  const auto count = static_cast<double>(tips.size());
  double squared = 0.0;
  for (const Vec3& tip : tips) {
    squared += (tip - mean / count).squared_norm();
  }
  return std::sqrt((count - 1.0) / count * squared);
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
    return refused("the tool turned by %.3f rad RMS, at least %.3f is needed", found.spread_rad,
                   options.min_spread_rad);
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

Judgement judged(const PivotCalibration& found, const PivotOptions& options) {
  Judgement judgement;
  const double fraction = static_cast<double>(found.inliers) / static_cast<double>(found.poses);
  if (found.spread_rad < options.note_spread_rad) {
    judgement.add(Verdict::kNote, with_numbers("turned by %.1f° RMS only, better %.1f°",
                                               found.spread_rad * kDegreesPerRadian,
                                               options.note_spread_rad * kDegreesPerRadian));
  }
  if (found.tip_sigma_m > options.note_tip_sigma_m) {
    judgement.add(Verdict::kNote,
                  with_numbers("the tip is known to %.2f mm only, better %.2f mm",
                               found.tip_sigma_m * 1e3, options.note_tip_sigma_m * 1e3));
  }
  if (fraction < options.note_inlier_fraction) {
    judgement.add(Verdict::kNote,
                  with_numbers("%.0f %% of the poses agree, better %.0f %%", 100.0 * fraction,
                               100.0 * options.note_inlier_fraction));
  }
  judgement.conclude();
  return judgement;
}

}  // namespace

std::vector<std::string> PivotOptions::check() const {
  std::vector<std::string> problems;
  const auto fraction = [&](const char* name, double value) {
    if (!(value > 0.0 && value <= 1.0)) {
      problems.push_back(std::string(name) + " " + printed("%f", value) +
                         ", must be above 0 and at most 1");
    }
  };
  if (min_poses < kSampleSize) {
    problems.push_back("min_poses " + std::to_string(min_poses) + ", must be at least " +
                       std::to_string(kSampleSize));
  }
  must_be_positive({{"min_spread_rad", min_spread_rad},
                    {"max_rmse_m", max_rmse_m},
                    {"inlier_m", inlier_m},
                    {"max_tip_sigma_m", max_tip_sigma_m},
                    {"note_spread_rad", note_spread_rad},
                    {"note_tip_sigma_m", note_tip_sigma_m}},
                   problems);
  fraction("min_inlier_fraction", min_inlier_fraction);
  fraction("note_inlier_fraction", note_inlier_fraction);
  if (rounds < 1) {
    problems.push_back("rounds " + std::to_string(rounds) + ", must be at least 1");
  }
  return problems;
}

Result<PivotCalibration> pivot_calibration(Poses poses, const PivotOptions& options) {
  if (Status status = check_poses(poses, options); !status) {
    return status.error();
  }
  std::optional<PivotFit> fit = best_fit(poses, options);
  if (!fit) {
    return refused("the tool turned by %.3f rad RMS, at least %.3f is needed", 0.0,
                   options.min_spread_rad);
  }
  const Indices inliers = settled(poses, options.inlier_m, *fit);
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
  found.leave_out_m = inliers.size() > kJackknifeBlocks ? jackknife_sigma_m(poses, inliers) : 0.0;
  found.tip_sigma_m = std::max(fit->tip_sigma_m, found.leave_out_m);
  if (Status status = check_result(found, options); !status) {
    return status.error();
  }
  found.judgement = judged(found, options);
  return found;
}

}  // namespace orthonav::nav
