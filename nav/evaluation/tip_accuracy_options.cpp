#include <algorithm>
#include <array>
#include <cstdio>

#include "base/printed.h"
#include "nav/evaluation/tip_accuracy.h"

namespace orthonav::nav {
namespace {

struct Number {
  const char* name;
  double value;
  double low;
  double high;
};

void check_number(const Number& number, std::vector<std::string>& problems) {
  if (number.value >= number.low && number.value <= number.high) {
    return;
  }
  problems.push_back(printed("accuracy test: %s %g, must be %g to %g", number.name, number.value,
                             number.low, number.high));
}

void check_limits(const char* name, const AccuracyLimits& limits,
                  std::vector<std::string>& problems) {
  if (limits.pass_m > 0.0 && limits.pass_m <= limits.note_m && limits.note_m <= 0.1) {
    return;
  }
  problems.push_back(
      printed("accuracy test: limits of %s %g and %g mm, must rise from above 0 to 100 mm", name,
              limits.pass_m * 1e3, limits.note_m * 1e3));
}

}  // namespace

std::vector<std::string> AccuracyOptions::check() const {
  std::vector<std::string> problems;
  const std::array<Number, 16> numbers = {{
      {"rests.radius_m", rests.radius_m, 1e-4, 0.05},
      {"rests.dwell_s", rests.dwell_s, 0.05, 60.0},
      {"rests.min_samples", static_cast<double>(rests.min_samples), 1, 1e6},
      {"rests.max_gap_s", rests.max_gap_s, 0.01, 60.0},
      {"rests.max_outliers", static_cast<double>(rests.max_outliers), 0, 100},
      {"rests.settle_s", rests.settle_s, 0.0, 10.0},
      {"still_angle_rad", still_angle_rad, 1e-3, 0.5},
      {"min_still_s", min_still_s, 0.1, 600.0},
      {"min_still_samples", static_cast<double>(min_still_samples), 2, 1e6},
      {"min_turning_s", min_turning_s, 0.5, 600.0},
      {"min_turning_spread_rad", min_turning_spread_rad, 0.01, 1.0},
      {"max_turning_rmse_m", max_turning_rmse_m, 1e-4, 0.05},
      {"max_tip_bias_m", max_tip_bias_m, 1e-4, 0.2},
      {"dimple_m", dimple_m, rests.radius_m, 0.2},
      {"max_slip_m", max_slip_m, 1e-5, 0.05},
      {"max_board_rmse_m", max_board_rmse_m, 1e-4, 1.0},
  }};
  for (const Number& number : numbers) {
    check_number(number, problems);
  }
  // With more, the number of choices would explode.
  if (max_stray_rests > 6) {
    problems.push_back("accuracy test: max_stray_rests " + std::to_string(max_stray_rests) +
                       ", limit 6");
  }
  check_limits("single_point_p95", single_point_p95, problems);
  check_limits("turning_p95", turning_p95, problems);
  check_limits("tip_bias", tip_bias, problems);
  check_limits("distance_mean", distance_mean, problems);
  check_limits("distance_max", distance_max, problems);
  return problems;
}

Verdict AccuracyPart::verdict() const {
  Verdict worst = failure.empty() ? Verdict::kPass : Verdict::kFail;
  for (const Judged& figure : judged) {
    worst = std::max(worst, figure.verdict);
  }
  return worst;
}

Verdict AccuracyReport::verdict() const {
  Verdict worst = std::max(single_point.verdict(), turning.verdict());
  if (distances) {
    worst = std::max(worst, distances->verdict());
  }
  return worst;
}

}  // namespace orthonav::nav
