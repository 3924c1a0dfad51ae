#include "engine/study/mean_interval.h"

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

MeanInterval mean_interval(std::span<const double> values) {
  const nav::Summary summary = nav::summarize(values);
  const auto n = static_cast<double>(summary.count);
  const double half = summary.count < 3 ? std::numeric_limits<double>::quiet_NaN()
                                        : student_t_975(n - 1.0) * summary.sd / std::sqrt(n);
  return {summary.mean, summary.mean - half, summary.mean + half};
}

}  // namespace orthonav::engine
