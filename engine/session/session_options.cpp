#include "engine/session/session_options.h"

#include <algorithm>
#include <cmath>

namespace orthonav::engine {

double SessionOptions::drift_since_m(Duration spread) const {
  // The variance of a random walk's end about its own mean.
  return map_drift_m_per_sqrt_s * std::sqrt(std::max(0.0, seconds(spread)) / 3.0);
}

namespace {

std::vector<std::string> problems_of_times(const SessionOptions& o) {
  std::vector<std::string> problems;
  if (o.stale_after <= Duration::zero() || o.stale_after > std::chrono::seconds(1)) {
    problems.push_back("stale_after must lie in (0, 1000] ms");
  }
  if (o.fade < Duration::zero()) {
    problems.push_back("fade must not be negative");
  }
  if (o.message_for <= Duration::zero()) {
    problems.push_back("message_for must be positive");
  }
  if (o.heard_for < Duration::zero()) {
    problems.push_back("heard_for must not be negative");
  }
  return problems;
}

}  // namespace

std::vector<std::string> DrillSkiving::check() const {
  std::vector<std::string> problems;
  if (!(direction_rad >= 0.0 && direction_rad <= 0.2)) {
    problems.push_back("direction_rad must lie in [0, 0.2]");
  }
  if (!(start_m >= 0.0 && start_m <= 0.01)) {
    problems.push_back("start_m must lie in [0, 0.01]");
  }
  return problems;
}

nav::RodBending SessionOptions::bending() const {
  nav::RodBending bending;
  bending.diameter_m = rod_diameter_m;
  return bending;
}

std::vector<std::string> SessionOptions::check() const {
  std::vector<std::string> problems;
  const auto add = [&problems](const char* of, const std::vector<std::string>& more) {
    for (const std::string& problem : more) {
      problems.push_back(of + problem);
    }
  };
  if (!(rod_diameter_m >= 0.001 && rod_diameter_m <= 0.02)) {
    problems.push_back("rod_diameter_m must lie in [0.001, 0.02]");
  }
  if (!(max_touch_spread_m > 0.0 && max_touch_spread_m <= 0.01)) {
    problems.push_back("max_touch_spread_m must lie in (0, 0.01]");
  }
  add("", problems_of_times(*this));
  add("", check_points.check());
  add("", placed.check());
  add("astray: ", astray.check());
  add("replan: ", replan.check());
  for (const double sd_m : {common.tip_m, common.cameras_m, common.map_m}) {
    if (!(sd_m >= 0.0 && sd_m <= 0.01)) {
      problems.push_back("common errors must lie in [0, 0.01]");
    }
  }
  if (!(map_drift_m_per_sqrt_s >= 0.0 && map_drift_m_per_sqrt_s <= 0.001)) {
    problems.push_back("map_drift_m_per_sqrt_s must lie in [0, 0.001]");
  }
  return problems;
}

}  // namespace orthonav::engine
