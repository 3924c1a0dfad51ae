#include "engine/session/session_options.h"

namespace orthonav::engine {

std::vector<std::string> SessionOptions::check() const {
  std::vector<std::string> problems;
  if (stale_after <= Duration::zero() || stale_after > std::chrono::seconds(1)) {
    problems.push_back("stale_after must lie in (0, 1000] ms");
  }
  if (!(min_voice_confidence >= 0.0 && min_voice_confidence <= 1.0)) {
    problems.push_back("min_voice_confidence must lie in [0, 1]");
  }
  if (!(rod_diameter_m >= 0.001 && rod_diameter_m <= 0.02)) {
    problems.push_back("rod_diameter_m must lie in [0.001, 0.02]");
  }
  if (fade < Duration::zero()) {
    problems.push_back("fade must not be negative");
  }
  if (!(max_touch_spread_m > 0.0 && max_touch_spread_m <= 0.01)) {
    problems.push_back("max_touch_spread_m must lie in (0, 0.01]");
  }
  for (const std::string& problem : check_points.check()) {
    problems.push_back(problem);
  }
  if (message_for <= Duration::zero()) {
    problems.push_back("message_for must be positive");
  }
  if (heard_for < Duration::zero()) {
    problems.push_back("heard_for must not be negative");
  }
  return problems;
}

}  // namespace orthonav::engine
