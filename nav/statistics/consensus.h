#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/random.h"
#include "nav/statistics/blocked_jackknife.h"
#include "nav/statistics/median.h"

namespace orthonav::nav {

/// What most of a number of measurements agree on, by random samples (RANSAC with truncated
/// squares, Torr & Zisserman 2000). `Fit` is copied.
template <class Fit>
struct Consensus {
  using Indices = std::vector<std::size_t>;

  std::size_t count = 0;
  /// A fit to some of the measurements; nothing if they do not determine one.
  std::function<std::optional<Fit>(std::span<const std::size_t>)> fit;
  std::function<double(const Fit&, std::size_t)> miss;  ///< of one measurement, >= 0
  /// A fit to a minimal random sample; nothing if the sample drawn does not determine one.
  std::function<std::optional<Fit>(Random&)> sample;
  double limit = 0.0;  ///< a measurement that misses by more is an outlier
  double least = 0.0;  ///< misses below this count as rounding
  /// The median miss of inliers divided by their SD in each direction: 1.538 in space, 1.177 in a
  /// plane.
  double median_of_sd = 0.0;

  [[nodiscard]] Indices within(const Fit& found, double limit_of_these) const {
    Indices inliers;
    for (std::size_t i = 0; i < count; ++i) {
      if (miss(found, i) <= limit_of_these) {
        inliers.push_back(i);
      }
    }
    return inliers;
  }

  /// The fit that most measurements agree with; the fit to all of them if no sample determines one.
  [[nodiscard]] std::optional<Fit> best(int rounds, Random& random) const {
    Indices all(count);
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::optional<Fit> found = fit(all);
    double least_cost = found ? cost(*found) : 0.0;
    for (int round = 0; round < rounds; ++round) {
      std::optional<Fit> tried = sample(random);
      if (!tried) {
        continue;
      }
      // A minimal sample amplifies noise; all measurements that agree with it locate the fit
      // better.
      if (auto again = fit(within(*tried, 2.0 * limit))) {
        tried = std::move(again);
      }
      const double tried_cost = cost(*tried);
      if (!found || tried_cost < least_cost) {
        found = std::move(tried);
        least_cost = tried_cost;
      }
    }
    return found;
  }

  /// Repeats the fit to its inliers until they no longer change; the limit follows their scatter.
  [[nodiscard]] Indices settle(Fit& found) const {
    constexpr int kMaxRefits = 20;
    Indices inliers;
    for (int round = 0; round < kMaxRefits; ++round) {
      Indices now = within(found, limit_of_scatter(found));
      const bool same = now == inliers;
      inliers = std::move(now);
      auto again = fit(inliers);
      if (same || !again) {
        break;
      }
      found = std::move(*again);
    }
    return inliers;
  }

  /// The fits without each of `kJackknifeBlocks` blocks of the inliers in turn (blocked jackknife).
  [[nodiscard]] std::vector<Fit> without_each_block(const Indices& inliers) const {
    std::vector<Fit> fits;
    for (std::size_t block = 0; block < kJackknifeBlocks; ++block) {
      Indices rest = without_block(inliers.size(), block);
      for (std::size_t& i : rest) {
        i = inliers[i];
      }
      if (auto without = fit(rest)) {
        fits.push_back(std::move(*without));
      }
    }
    return fits;
  }

 private:
  /// Squared misses, each counted up to the limit.
  [[nodiscard]] double cost(const Fit& found) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double each = std::min(miss(found, i), limit);
      sum += each * each;
    }
    return sum;
  }

  /// The limit from the measurements nearest to the fit: only one in some thousands lies beyond 4.5
  /// SDs.
  [[nodiscard]] double limit_of_scatter(const Fit& found) const {
    std::vector<double> misses;
    for (const std::size_t i : within(found, limit)) {
      misses.push_back(miss(found, i));
    }
    if (misses.empty()) {
      return limit;
    }
    constexpr double kInlierSds = 4.5;
    return std::clamp(kInlierSds * median(std::move(misses)) / median_of_sd, least, limit);
  }
};

}  // namespace orthonav::nav
