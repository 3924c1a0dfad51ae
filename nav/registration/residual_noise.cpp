#include "nav/registration/residual_noise.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

/// 4 s at 30 Hz: longer than a hand's wandering stays correlated.
constexpr std::size_t kLongestLag = 120;
constexpr double kFewestPairsAtLag = 30.0;
/// The autocorrelation is followed until it falls below this; smaller values are dominated by
/// chance.
constexpr double kNoiseCorrelation = 0.1;
constexpr double kSlowest = 0.985;
constexpr double kFastest = 0.05;
/// At least this fraction of the variance is noise, and at least this fraction of the noise is
/// white.
constexpr double kLeastNoise = 0.05;
constexpr double kLeastWhite = 0.01;

/// The ratio of a geometric series that begins with 1 and whose first `terms` add up to `sum`: this
/// uses all lags, while the last one alone would be dominated by chance.
double ratio_of_series(double sum, std::size_t terms) {
  double low = kFastest;
  double high = kSlowest;
  for (int halved = 0; halved < 30; ++halved) {
    const double middle = 0.5 * (low + high);
    const double series = (1.0 - std::pow(middle, static_cast<double>(terms))) / (1.0 - middle);
    (series < sum ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

struct Weighed {
  Vec3 at_m;
  double weight = 0.0;
  double residual = 0.0;  ///< times its weight
  int stroke = 0;
};

/// The points along the strokes, contiguous in memory.
std::vector<Weighed> weighed(const SurfaceFit& fit, const ResidualUnits& units) {
  std::vector<Weighed> out;
  out.reserve(units.order.size());
  for (std::size_t k = 0; k < units.order.size(); ++k) {
    const FittedPoint& p = fit.points[units.order[k]];
    const double weight = p.inlier_precision();
    out.push_back({p.lever_arm_m, weight, weight * p.residual_m, units.stroke[k]});
  }
  return out;
}

}  // namespace

AlongStrokes along_strokes(const SurfaceFit& fit, const ResidualUnits& units) {
  AlongStrokes out;
  const std::vector<Weighed> points = weighed(fit, units);
  for (std::size_t lag = 0; lag < std::min(kLongestLag, points.size()); ++lag) {
    double product = 0.0;
    double distance = 0.0;
    double weights = 0.0;
    double pairs = 0.0;
    for (std::size_t k = 0; k + lag < points.size(); ++k) {
      const Weighed& a = points[k];
      const Weighed& b = points[k + lag];
      if (a.stroke != b.stroke) {
        continue;
      }
      const double weight = a.weight * b.weight;
      product += a.residual * b.residual;
      distance += weight * (a.at_m - b.at_m).norm();
      weights += weight;
      pairs += 1.0;
    }
    if (pairs < kFewestPairsAtLag || (lag > 0 && !units.along_strokes)) {
      break;
    }
    out.covariance_m2.push_back(product / weights);
    out.distance_m.push_back(distance / weights);
    if (out.covariance_m2.back() < kNoiseCorrelation * kLeastNoise * out.covariance_m2.front()) {
      break;
    }
  }
  return out;
}

double FieldHypothesis::correlation(double distance_m) const {
  return std::exp(-distance_m / length_m);
}

StrokeNoise noise_beside_field(const AlongStrokes& seen, const FieldHypothesis& field) {
  const double variance_m2 = field.sd_m * field.sd_m;
  const double stroke_m2 = field.stroke_sd_m * field.stroke_sd_m;
  std::vector<double> rest_m2;
  for (std::size_t lag = 0; lag < seen.covariance_m2.size(); ++lag) {
    const double of_field_m2 =
        variance_m2 > 0.0 ? variance_m2 * field.correlation(seen.distance_m[lag]) : 0.0;
    rest_m2.push_back(seen.covariance_m2[lag] - of_field_m2 - stroke_m2);
  }
  StrokeNoise out;
  const double all_m2 = std::max(rest_m2[0], kLeastNoise * seen.covariance_m2[0]);
  std::size_t last = 0;
  double sum_m2 = 0.0;
  while (last + 1 < rest_m2.size() && rest_m2[last + 1] > kNoiseCorrelation * all_m2) {
    sum_m2 += rest_m2[++last];
  }
  if (last >= 1) {
    const double kept = last >= 2 ? ratio_of_series(sum_m2 / rest_m2[1], last) : kNoiseCorrelation;
    out.kept = std::clamp(std::pow(kept, 1.0 / field.noise_time), kFastest, kSlowest);
    out.wandering_m2 = std::min(rest_m2[1] / out.kept, all_m2);
  }
  out.white_m2 = std::max(all_m2 - out.wandering_m2, kLeastWhite * all_m2);
  return out;
}

}  // namespace orthonav::nav
