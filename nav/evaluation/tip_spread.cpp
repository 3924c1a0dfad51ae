#include "nav/evaluation/tip_spread.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace orthonav::nav {
namespace {

constexpr double kSpreadBlock_s = 0.25;
// One second for each mean.
constexpr std::size_t kLeastBlocks = 4;
constexpr double kSignificance = 4.0;

/// The noise of neighbouring samples is correlated, but hardly that of quarter-second means.
std::vector<TipSample> block_means(std::span<const TipSample> samples) {
  std::vector<TipSample> blocks;
  for (std::size_t first = 0; first < samples.size();) {
    TipSample block;
    std::size_t i = first;
    for (; i < samples.size() && samples[i].time_s < samples[first].time_s + kSpreadBlock_s; ++i) {
      block.tip_m += samples[i].tip_m;
      block.time_s += samples[i].time_s;
    }
    const auto count = static_cast<double>(i - first);
    blocks.push_back({block.time_s / count, block.tip_m / count});
    first = i;
  }
  return blocks;
}

struct BlockMean {
  Vec3 mean_m{};
  double variance_of_mean_m2 = 0.0;
};

BlockMean block_mean(std::span<const TipSample> blocks) {
  const auto n = static_cast<double>(blocks.size());
  BlockMean mean;
  for (const TipSample& block : blocks) {
    mean.mean_m += block.tip_m / n;
  }
  double squares = 0.0;
  for (const TipSample& block : blocks) {
    squares += (block.tip_m - mean.mean_m).squared_norm();
  }
  mean.variance_of_mean_m2 = squares / (n - 1.0) / n;
  return mean;
}

}  // namespace

TipSpread tip_spread(std::span<const TipSample> samples) {
  TipSpread spread;
  spread.samples = samples.size();
  if (samples.empty()) {
    return spread;
  }
  const auto n = static_cast<double>(samples.size());
  for (const TipSample& sample : samples) {
    spread.mean_m += sample.tip_m / n;
  }
  std::vector<double> distances_m;
  double squares = 0.0;
  for (const TipSample& sample : samples) {
    distances_m.push_back((sample.tip_m - spread.mean_m).norm());
    squares += distances_m.back() * distances_m.back();
  }
  std::sort(distances_m.begin(), distances_m.end());
  const auto rank = static_cast<std::size_t>(std::ceil(0.95 * n));
  spread.rms_m = std::sqrt(squares / n);
  spread.p95_m = distances_m[rank - 1];
  spread.max_m = distances_m.back();
  return spread;
}

std::optional<TipSlip> tip_slip(std::span<const TipSample> samples, double max_step_m) {
  const std::vector<TipSample> blocks = block_means(samples);
  const std::span<const TipSample> all(blocks);
  std::optional<TipSlip> worst;
  for (std::size_t split = kLeastBlocks; split + kLeastBlocks <= blocks.size(); ++split) {
    const BlockMean before = block_mean(all.first(split));
    const BlockMean after = block_mean(all.subspan(split));
    const double step_m = (after.mean_m - before.mean_m).norm();
    const double scatter_m = std::sqrt(before.variance_of_mean_m2 + after.variance_of_mean_m2);
    if (step_m <= max_step_m || step_m <= kSignificance * scatter_m) {
      continue;
    }
    if (!worst || step_m > worst->step_m) {
      worst = TipSlip{blocks[split].time_s, step_m};
    }
  }
  return worst;
}

}  // namespace orthonav::nav
