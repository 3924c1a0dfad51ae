#include "study/mean_interval.h"

#include <cmath>
#include <limits>

#include "base/random.h"
#include "nav/evaluation/errors.h"

namespace orthonav::engine {

double student_t_975(double freedom) {
  constexpr double kProbability = 0.975;
  if (freedom == 2.0) {  // the series is 3 % off here
    return (2.0 * kProbability - 1.0) / std::sqrt(2.0 * kProbability * (1.0 - kProbability));
  }
  const double z = normal_quantile(kProbability);
  const double z2 = z * z;
  return z * (1.0 + (z2 + 1.0) / (4.0 * freedom) +
              ((5.0 * z2 + 16.0) * z2 + 3.0) / (96.0 * freedom * freedom) +
              (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / (384.0 * std::pow(freedom, 3.0)));
}

namespace {

/// Half-width of the interval of a mean of `count` values, in standard errors.
double factor_of(std::size_t count) {
  return count < 3 ? std::numeric_limits<double>::quiet_NaN()
                   : student_t_975(static_cast<double>(count) - 1.0);
}

MeanInterval around(double mean, double half) { return {mean, mean - half, mean + half}; }

}  // namespace

MeanInterval mean_interval(std::span<const double> values) {
  const nav::Summary summary = nav::summarize(values);
  return around(summary.mean, factor_of(summary.count) * summary.sd /
                                  std::sqrt(static_cast<double>(summary.count)));
}

MeanInterval mean_interval(double mean, double standard_error, std::size_t count) {
  return around(mean, factor_of(count) * standard_error);
}

}  // namespace orthonav::engine
