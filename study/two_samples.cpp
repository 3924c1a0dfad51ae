#include "study/two_samples.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "nav/evaluation/errors.h"

namespace orthonav::engine {
namespace {

/// Lentz's evaluation of the continued fraction of I_x(a, b).
double beta_fraction(double x, double a, double b) {
  constexpr double kTiny = 1e-300;
  constexpr int kTerms = 500;
  const auto safe = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = 1.0;
  double d = 1.0 / safe(1.0 - (a + b) * x / (a + 1.0));
  double out = d;
  for (int m = 1; m < kTerms; ++m) {
    const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
    d = 1.0 / safe(1.0 + even * d);
    c = safe(1.0 + even / c);
    out *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    d = 1.0 / safe(1.0 + odd * d);
    c = safe(1.0 + odd / c);
    out *= d * c;
    if (std::abs(d * c - 1.0) < 1e-14) {
      break;
    }
  }
  return out;
}

/// Of a positive number. std::lgamma leaves the sign in a variable that all threads share.
double log_gamma(double x) {
  int sign = 1;
  return ::lgamma_r(x, &sign);
}

double incomplete_beta(double x, double a, double b) {
  if (x <= 0.0 || x >= 1.0) {
    return x <= 0.0 ? 0.0 : 1.0;
  }
  const double front = std::exp(log_gamma(a + b) - log_gamma(a) - log_gamma(b) + a * std::log(x) +
                                b * std::log1p(-x));
  return x < (a + 1.0) / (a + b + 2.0) ? front * beta_fraction(x, a, b) / a
                                       : 1.0 - front * beta_fraction(1.0 - x, b, a) / b;
}

}  // namespace

double student_p(double t, double freedom) {
  return incomplete_beta(freedom / (freedom + t * t), 0.5 * freedom, 0.5);
}

double equivalence_p(std::span<const double> differences, double margin) {
  const nav::Summary summary = nav::summarize(differences);
  if (summary.count < 3) {
    return 1.0;
  }
  const double inside = margin - std::abs(summary.mean);
  const double error = summary.sd / std::sqrt(static_cast<double>(summary.count));
  if (!(error > 0.0)) {
    return inside > 0.0 ? 0.0 : 1.0;
  }
  const double both = student_p(inside / error, static_cast<double>(summary.count) - 1.0);
  return inside > 0.0 ? 0.5 * both : 1.0 - 0.5 * both;
}

}  // namespace orthonav::engine
