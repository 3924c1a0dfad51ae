#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "hal/sim/room/noise.h"
#include "nav/guidance/rod_expectation.h"
#include "study/rod_bench.h"

namespace orthonav::engine {
namespace {

nav::RodBending bending_of(const RodExperimentOptions& options) {
  nav::RodBending bending;
  bending.bender.width_m = options.bend_width_m;
  bending.material.yield_pa = options.yield_pa;
  bending.material.modulus_pa = options.modulus_pa;
  bending.diameter_m = options.rod_diameter_m;
  bending.overhang_m = options.overhang_m;
  return bending;
}

/// A rod as its instructions would lay it in the seats.
RodInHand laid_rod(std::span<const nav::RodArc> rod, double length_m, const nav::RodFit& fit) {
  std::vector<Vec3> places_m = nav::rod_axis(rod, length_m);
  for (Vec3& place_m : places_m) {
    place_m = fit.seats_from_rod * place_m + fit.rod_in_seats_m;
  }
  return RodInHand::along(std::move(places_m));
}

}  // namespace

nav::RodArc RodBench::bent_as_told(const nav::RodInstruction& told,
                                   const nav::RodSpringBack& spring_back, double stiffness) {
  work(options_.durations.mark_s);
  work(options_.durations.bend_s);
  const double set_rad =
      std::max(0.0, told.set_rad + random_.normal(0.0, options_.bender_setting_rad));
  const double recovered_rad = stiffness * (set_rad - spring_back.kept_rad(set_rad));
  nav::RodArc arc = told.arc;
  arc.angle_rad = std::max(0.0, set_rad - recovered_rad);
  arc.roll_rad += random_.normal(0.0, options_.roll_setting_rad);
  arc.centre_m += random_.normal(0.0, options_.length_reading_m);
  return arc;
}

InstructedRod RodBench::with_instructions() {
  const nav::RodCut shown = options_.in_socket ? touched_in_sockets() : touched();
  const nav::RodBending bending = bending_of(options_);
  const auto plan = nav::rod_instructions(shown.seats_m, bending);
  if (!plan) {
    return {.rod = matched(shown)};
  }
  const double length_m = cut_to(plan->cut_length_m());
  if (options_.ends_marked) {
    work(options_.durations.mark_s);
  }
  const nav::RodSpringBack spring_back =
      nav::RodSpringBack::of(bending.bender, bending.material, bending.diameter_m).value();
  const double stiffness = 1.0 + random_.normal(0.0, options_.spring_back_error);
  std::vector<nav::RodArc> bent;
  for (const nav::RodInstruction& bend : plan->bends) {
    bent.push_back(bent_as_told(bend, spring_back, stiffness));
  }
  const RodInHand rod = laid_rod(bent, length_m, plan->fit);
  InstructedRod out;
  out.bends = plan->bends.size();
  const std::vector<double> seat_sd_m(shown.seats_m.size(), head_sd_m());
  out.expected_within =
      nav::rod_expectation(plan->fit, seat_sd_m, {.limit_m = kInstructedLimit_m}).within;
  out.off_touched_m = RodInHand(rod).lay_on(shown.seats_m).largest_m;
  out.off_heads_m = RodInHand(rod).lay_on(task_.cut.seats_m).largest_m;
  out.rod = finished(rod, length_m, &RodInHand::worst_bend_near,
                     options_.ends_marked ? options_.placing_by_marks_m : options_.placing_m);
  return out;
}

}  // namespace orthonav::engine
