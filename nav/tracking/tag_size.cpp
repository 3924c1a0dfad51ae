#include "nav/tracking/tag_size.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {

bool TagSizeEstimator::is_due() {
  ++pairs_;
  return measurements_ < options_.first || pairs_ % options_.then_every == 0;
}

void TagSizeEstimator::add(const SizeEvidence& measured) {
  const double sd = std::max(measured.sd, options_.least_sd);
  if (!std::isfinite(sd) || !std::isfinite(measured.fraction)) {
    return;
  }
  information_ += 1.0 / (sd * sd);
  sum_ += measured.fraction / (sd * sd);
  ++measurements_;
}

std::optional<TagSize> TagSizeEstimator::estimate() const {
  if (measurements_ == 0) {
    return std::nullopt;
  }
  TagSize out;
  out.fraction = sum_ / information_;
  out.sd = 1.0 / std::sqrt(information_);
  out.measurements = measurements_;
  out.notable = std::abs(out.fraction) > options_.min_fraction;
  out.disagrees = out.notable && measurements_ >= options_.first &&
                  std::abs(out.fraction) > options_.certain_sd * out.sd;
  return out;
}

}  // namespace orthonav::nav
