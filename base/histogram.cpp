#include "base/histogram.h"

#include <algorithm>
#include <cmath>

namespace orthonav {

void Histogram::add(double value) {
  least_ = count_ == 0 ? value : std::min(least_, value);
  most_ = count_ == 0 ? value : std::max(most_, value);
  sum_ += value;
  ++count_;
  const double bin = value > kLeast ? std::log(value / kLeast) / std::log(kWidth) : 0.0;
  ++bins_[std::min(static_cast<std::size_t>(std::min(bin, 1.0 * kBins)), kBins - 1)];
}

std::optional<double> Histogram::quantile(double fraction) const {
  if (count_ == 0) {
    return std::nullopt;
  }
  const auto rank = static_cast<std::int64_t>(std::ceil(fraction * static_cast<double>(count_)));
  if (rank <= 1 || rank >= count_) {
    return rank <= 1 ? least_ : most_;
  }
  std::size_t bin = 0;
  for (std::int64_t below = bins_[0]; below < rank; below += bins_[bin]) {
    ++bin;
  }
  const double middle = kLeast * std::pow(kWidth, static_cast<double>(bin) + 0.5);
  return std::clamp(middle, least_, most_);
}

std::optional<double> Histogram::mean() const {
  return count_ == 0 ? std::nullopt : std::optional(sum_ / static_cast<double>(count_));
}

}  // namespace orthonav
