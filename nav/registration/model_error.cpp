#include "nav/registration/model_error.h"

#include <array>
#include <cmath>

namespace orthonav::nav {
namespace {

constexpr std::array<double, 8> kModelSds_m = {0.0001, 0.0002,  0.0003, 0.0004,
                                               0.0005, 0.00065, 0.0008, 0.001};
constexpr std::array<double, 3> kModelLengths_m = {0.005, 0.007, 0.010};
constexpr double kModelSpread = 0.5;  ///< SD of the natural logarithm

}  // namespace

std::vector<ModelErrorHypothesis> model_error_hypotheses() {
  std::vector<ModelErrorHypothesis> all;
  for (const double sd_m : kModelSds_m) {
    const double off = std::log(sd_m / kUsualModelError_m) / kModelSpread;
    for (const double length_m : kModelLengths_m) {
      all.push_back({{sd_m, length_m}, -0.5 * off * off});
    }
  }
  return all;
}

double smooth_correlation(double lengths) {
  return (1.0 + kSmoothScale * lengths) * std::exp(-kSmoothScale * lengths);
}

double shared_error_m2(const ModelError& error, Vec3 a, Vec3 b) {
  return error.sd_m * error.sd_m * smooth_correlation((a - b).norm() / error.length_m);
}

}  // namespace orthonav::nav
