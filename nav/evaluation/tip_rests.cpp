#include "nav/evaluation/tip_rests.h"

#include <algorithm>

namespace orthonav::nav {
namespace {

using Samples = std::span<const TipSample>;

/// A tip rests for at least this long, in at least this many samples.
constexpr double kDwell_s = 0.5;
constexpr std::size_t kLeastRestSamples = 4;
/// This many samples in a row may lie elsewhere without ending a rest; they are left out.
constexpr std::size_t kMaxOutliers = 2;

Vec3 mean_of(Samples samples, const std::vector<std::size_t>& indices) {
  Vec3 sum_m{};
  for (const std::size_t i : indices) {
    sum_m += samples[i].tip_m;
  }
  return sum_m / static_cast<double>(indices.size());
}

/// The shortest stretch from `first` on that could be a rest; empty when a gap or the end of the
/// data comes before.
std::vector<std::size_t> shortest(Samples samples, std::size_t first) {
  std::vector<std::size_t> indices;
  for (std::size_t i = first; i < samples.size(); ++i) {
    if (i > first && samples[i].time_s - samples[i - 1].time_s > kLongestGap_s) {
      break;
    }
    indices.push_back(i);
    if (samples[i].time_s - samples[first].time_s >= kDwell_s &&
        indices.size() >= kLeastRestSamples) {
      return indices;
    }
  }
  return {};
}

bool lie_together(Samples samples, const std::vector<std::size_t>& indices, double radius_m) {
  const Vec3 mean_m = mean_of(samples, indices);
  return std::all_of(indices.begin(), indices.end(),
                     [&](std::size_t i) { return (samples[i].tip_m - mean_m).norm() <= radius_m; });
}

/// Extends the rest while samples stay near its mean so far.
void grow(Samples samples, std::vector<std::size_t>& indices) {
  Vec3 sum_m = static_cast<double>(indices.size()) * mean_of(samples, indices);
  std::size_t outliers = 0;
  for (std::size_t i = indices.back() + 1; i < samples.size(); ++i) {
    if (samples[i].time_s - samples[i - 1].time_s > kLongestGap_s) {
      return;
    }
    const Vec3 mean_m = sum_m / static_cast<double>(indices.size());
    if ((samples[i].tip_m - mean_m).norm() > kRestRadius_m) {
      if (++outliers > kMaxOutliers) {
        return;
      }
      continue;
    }
    outliers = 0;
    sum_m += samples[i].tip_m;
    indices.push_back(i);
  }
}

TipRest settled(Samples samples, const std::vector<std::size_t>& indices) {
  const double start_s = samples[indices.front()].time_s;
  const double stop_s = samples[indices.back()].time_s;
  const double ends_s = std::min(kSettle_s, (stop_s - start_s) / 3.0);
  TipRest rest;
  for (const std::size_t i : indices) {
    if (samples[i].time_s >= start_s + ends_s && samples[i].time_s <= stop_s - ends_s) {
      rest.samples.push_back(i);
    }
  }
  // Few and uneven samples may leave the middle empty.
  if (rest.samples.empty()) {
    rest.samples.push_back(indices[indices.size() / 2]);
  }
  rest.mean_m = mean_of(samples, rest.samples);
  return rest;
}

void append_or_join(Samples samples, const TipRest& rest, double radius_m,
                    std::vector<TipRest>& rests) {
  if (rests.empty() || (rests.back().mean_m - rest.mean_m).norm() > radius_m) {
    rests.push_back(rest);
    return;
  }
  TipRest& last = rests.back();
  last.samples.insert(last.samples.end(), rest.samples.begin(), rest.samples.end());
  last.mean_m = mean_of(samples, last.samples);
}

}  // namespace

std::vector<TipRest> tip_rests(std::span<const TipSample> samples) {
  std::vector<TipRest> rests;
  for (std::size_t first = 0; first < samples.size();) {
    std::vector<std::size_t> indices = shortest(samples, first);
    if (indices.empty() || !lie_together(samples, indices, kRestRadius_m)) {
      ++first;
      continue;
    }
    grow(samples, indices);
    append_or_join(samples, settled(samples, indices), kRestRadius_m, rests);
    first = indices.back() + 1;
  }
  return rests;
}

}  // namespace orthonav::nav
