#include "engine/case/screw_breach.h"

#include <cmath>

#include "base/printed.h"
#include "nav/guidance/screw_clearance.h"

namespace orthonav::engine {

std::optional<std::string> breach_problem(const nav::VertebraModel& bone,
                                          const nav::ScrewPlan& screw) {
  const auto cylinder = nav::cylinder_of(screw);
  if (!cylinder || !screw.accepted_breach.empty()) {
    return std::nullopt;
  }
  const auto least = nav::least_clearance(bone.surface(), *cylinder);
  if (!least || !(least->clearance_m < 0.0)) {
    return std::nullopt;
  }
  return name_of(screw.side) + std::string(" screw breaks through the cortex: clearance ") +
         beside_limit("%.1f mm, limit %.1f mm", least->clearance_m * 1e3, 0.0) + " (" +
         nav::direction_of(*least, screw.side) +
         printed(
             ", %.0f mm past the entry); plan another one, or state why in its "
             "\"accept_breach\"",
             least->arc_length_m * 1e3);
}

std::string clearance_text(double clearance_m) {
  // What is a tenth but for its last bits stays that tenth.
  return printed("%.1f", std::floor(clearance_m * 1e4 + 1e-6) / 10.0);
}

}  // namespace orthonav::engine
