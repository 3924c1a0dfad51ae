#include "nav/registration/residual_noise.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

/// The hand forgets within 4 s at 30 Hz.
constexpr std::size_t kLongestLag = 120;
constexpr double kFewestPairs = 30.0;
/// The autocorrelation is followed until it falls below this; smaller values drown in chance.
constexpr double kNoiseCorrelation = 0.1;
constexpr double kSlowest = 0.985;
constexpr double kFastest = 0.05;
/// At least this fraction of the variance is noise, and of the noise white.
constexpr double kLeastNoise = 0.05;
constexpr double kLeastWhite = 0.01;

}  // namespace

AlongStrokes along_strokes(const SurfaceFit& fit, const ResidualUnits& units) {
  AlongStrokes out;
  const std::size_t n = units.order.size();
  for (std::size_t lag = 0; lag < std::min(kLongestLag, n); ++lag) {
    double product = 0.0;
    double distance = 0.0;
    double weights = 0.0;
    double pairs = 0.0;
    for (std::size_t k = 0; k + lag < n; ++k) {
      if (units.stroke[k] != units.stroke[k + lag]) {
        continue;
      }
      const FittedPoint& a = fit.points[units.order[k]];
      const FittedPoint& b = fit.points[units.order[k + lag]];
      const double weight = a.inlier_precision() * b.inlier_precision();
      product += weight * a.residual_m * b.residual_m;
      distance += weight * (a.lever_arm_m - b.lever_arm_m).norm();
      weights += weight;
      pairs += 1.0;
    }
    if (pairs < kFewestPairs || (lag > 0 && !units.along_strokes)) {
      break;
    }
    out.covariance_m2.push_back(product / weights);
    out.distance_m.push_back(distance / weights);
  }
  return out;
}

StrokeNoise noise_beside_field(const AlongStrokes& seen, double field_m2, double length_m) {
  std::vector<double> rest_m2;
  for (std::size_t lag = 0; lag < seen.covariance_m2.size(); ++lag) {
    const double of_field_m2 =
        field_m2 > 0.0 ? field_m2 * std::exp(-seen.distance_m[lag] / length_m) : 0.0;
    rest_m2.push_back(seen.covariance_m2[lag] - of_field_m2);
  }
  StrokeNoise out;
  const double all_m2 = std::max(rest_m2[0], kLeastNoise * seen.covariance_m2[0]);
  std::size_t last = 0;
  while (last + 1 < rest_m2.size() && rest_m2[last + 1] > kNoiseCorrelation * all_m2) {
    ++last;
  }
  if (last >= 1) {
    const double falls =
        last >= 2 ? std::pow(rest_m2[last] / rest_m2[1], 1.0 / static_cast<double>(last - 1))
                  : kNoiseCorrelation;
    out.kept = std::clamp(falls, kFastest, kSlowest);
    out.wandering_m2 = std::min(rest_m2[1] / out.kept, all_m2);
  }
  out.white_m2 = std::max(all_m2 - out.wandering_m2, kLeastWhite * all_m2);
  return out;
}

}  // namespace orthonav::nav
