#include <cmath>
#include <string>
#include <utility>

#include "base/printed.h"
#include "nav/guidance/rod_cut.h"
#include "study/rod_experiment.h"
#include "study/rod_in_hand.h"

namespace orthonav::engine {
namespace {

struct RodRange {
  const char* name;
  double value;
  double lowest;
  double highest;
};

/// Heads must be far enough apart that touching them with the allowed errors still gives a rod.
constexpr double kClosestHeads_m = 0.015;
/// Cosine of 45°; its heads lie one above the other.
constexpr double kAlongBuiltInSpine = 0.7071;

std::vector<RodRange> rod_ranges(const RodExperimentOptions& o) {
  return {{"rods", static_cast<double>(o.rods), 1, 100000},
          {"head_to_seat_m", o.head_to_seat_m, 0, 0.015},
          {"rod_diameter_m", o.rod_diameter_m, nav::kThinnestRod_m, nav::kThickestRod_m},
          {"yield_pa", o.yield_pa, 1e7, 3e9},
          {"modulus_pa", o.modulus_pa, 1e9, 4e11},
          {"bend_width_m", o.bend_width_m, 0, 0.05},
          {"shortest_overhang_m", o.shortest_overhang_m, 0, o.overhang_m},
          {"overhang_m", o.overhang_m, o.shortest_overhang_m, o.longest_overhang_m},
          {"longest_overhang_m", o.longest_overhang_m, o.overhang_m, nav::kLongestOverhang_m},
          {"head_pick_m", o.head_pick_m, 0, 0.003},
          {"navigation_m", o.navigation_m, 0, 0.003},
          {"perception_m", o.perception_m, 0, 0.005},
          {"matched_m", o.matched_m, 0, 0.02},
          {"most_matching_bends", static_cast<double>(o.most_matching_bends), 1, 20},
          {"assumed_head_to_seat_m", o.assumed_head_to_seat_m, 0, 0.015},
          {"length_reading_m", o.length_reading_m, 0, 0.01},
          {"eye_length_sd", o.eye_length_sd, 0, 0.25},
          {"eye_overbend_rad_per_m", o.eye_overbend_rad_per_m, 0, 10},
          {"eye_bend_sd", o.eye_bend_sd, 0, 1},
          {"eye_place_m", o.eye_place_m, 0, 0.0025},
          {"socket_seating_m", o.socket_seating_m, 0, 0.003},
          {"neighbour_navigation_m", o.neighbour_navigation_m, 0, 0.003},
          {"head_touches", static_cast<double>(o.head_touches), 1, 20},
          {"long_rod_touches", static_cast<double>(o.long_rod_touches), 1, 20},
          {"placing_by_marks_m", o.placing_by_marks_m, 0, 0.01},
          {"spring_back_error", o.spring_back_error, 0, 1},
          {"bender_setting_rad", o.bender_setting_rad, 0, 0.2},
          {"roll_setting_rad", o.roll_setting_rad, 0, 0.5},
          {"recovery_error", o.recovery_error, 0, 1},
          {"cutting_m", o.cutting_m, 0, 0.01},
          {"placing_m", o.placing_m, 0, 0.01},
          {"missed_m", o.missed_m, 0, 0.02},
          {"most_rebends", static_cast<double>(o.most_rebends), 0, 100},
          {"pace", o.pace, 0.01, 100},
          {"pace_sd", o.pace_sd, 0, 1}};
}

std::vector<RodRange> rod_duration_ranges(const RodStepDurations& d) {
  return {{"durations.touch_head_s", d.touch_head_s, 0, 3600},
          {"durations.measure_s", d.measure_s, 0, 3600},
          {"durations.cut_s", d.cut_s, 0, 3600},
          {"durations.bend_s", d.bend_s, 0, 3600},
          {"durations.compare_s", d.compare_s, 0, 3600},
          {"durations.try_s", d.try_s, 0, 3600},
          {"durations.take_out_s", d.take_out_s, 0, 3600},
          {"durations.mark_s", d.mark_s, 0, 3600},
          {"durations.touch_again_s", d.touch_again_s, 0, 3600},
          {"durations.scatter", d.scatter, 0, 1}};
}

std::string problem_of_heads(const RodExperimentOptions& options) {
  const auto rod = nav::rod_template(options.heads_m, 0.0055);
  if (!rod) {
    return "heads_m: " + rod.error().message;
  }
  for (std::size_t i = 0; i + 1 < rod->heads_m.size(); ++i) {
    const double gap_m = (rod->heads_m[i + 1] - rod->heads_m[i]).norm();
    if (gap_m < kClosestHeads_m) {
      return printed("heads_m: neighbours are %s mm apart, at least 15 mm",
                     value_beside(gap_m * 1e3, kClosestHeads_m * 1e3, 1).c_str());
    }
  }
  for (const Vec3& direction : rod_screw_directions(rod->heads_m, options.to_bone)) {
    if (direction.norm() == 0.0) {
      return "to_bone: the rod runs along it";
    }
  }
  return "";
}

}  // namespace

std::vector<std::string> RodExperimentOptions::check() const {
  std::vector<std::string> problems;
  std::vector<RodRange> ranges = rod_ranges(*this);
  for (const RodRange& range : rod_duration_ranges(durations)) {
    ranges.push_back(range);
  }
  for (const RodRange& range : ranges) {
    if (!(range.value >= range.lowest && range.value <= range.highest)) {
      problems.push_back(
          printed("%s is %g, limit %g-%g", range.name, range.value, range.lowest, range.highest));
    }
  }
  if (!(to_bone.is_finite() && to_bone.norm() > 0.0)) {
    problems.emplace_back("to_bone is zero or not finite");
  } else if (heads_m.empty()) {
    if (std::abs(to_bone.normalized().z) > kAlongBuiltInSpine) {
      problems.emplace_back("to_bone runs along the built-in spine, limit 45° from it");
    }
  } else {
    if (std::string problem = problem_of_heads(*this); !problem.empty()) {
      problems.push_back(std::move(problem));
    }
  }
  return problems;
}

}  // namespace orthonav::engine
