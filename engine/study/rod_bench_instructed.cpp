#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/study/rod_bench.h"
#include "hal/sim/noise.h"
#include "nav/guidance/rod_expectation.h"
#include "nav/guidance/rod_stroke.h"

namespace orthonav::engine {
namespace {

/// Distance over which the error that tracking has in common changes. Estimate.
constexpr double kTrackingVaries_m = 0.05;

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

/// A place on a chain of chords, and its direction there.
struct ChainPlace {
  Vec3 at_m;
  Vec3 direction;
};

ChainPlace place_along(const std::vector<Vec3>& chain_m, double along_m) {
  std::size_t i = 0;
  double left_m = along_m;
  while (i + 2 < chain_m.size() && left_m > (chain_m[i + 1] - chain_m[i]).norm()) {
    left_m -= (chain_m[i + 1] - chain_m[i]).norm();
    ++i;
  }
  const Vec3 direction = (chain_m[i + 1] - chain_m[i]).normalized();
  return {chain_m[i] + left_m * direction, direction};
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

/// On three sides of the rod, each from its first end.
std::vector<Vec3> RodBench::stroked(std::span<const nav::RodArc> rod, double length_m) {
  work(options_.durations.stroke_s);
  const std::vector<Vec3> chain_m = nav::rod_axis(rod, length_m);
  const double tracking_sd_m =
      options_.in_socket ? options_.neighbour_navigation_m : options_.navigation_m / std::sqrt(2.0);
  std::vector<Vec3> tracking_m;
  for (double at_m = 0.0; at_m < length_m + kTrackingVaries_m; at_m += kTrackingVaries_m) {
    tracking_m.push_back(sim::normal_vector(random_, tracking_sd_m));
  }
  std::vector<Vec3> points_m;
  constexpr int kSides = 3;
  const int passed = options_.stroke_points / kSides;
  for (int side = 0; side < kSides; ++side) {
    const double about_rad = 2.0 * std::numbers::pi * side / kSides;
    for (int i = 0; i < passed; ++i) {
      const double along_m = length_m * (i + 0.5) / passed;
      const ChainPlace place = place_along(chain_m, along_m);
      const Vec3 across{std::cos(about_rad), std::sin(about_rad), 0.0};
      const Vec3 out = (across - across.dot(place.direction) * place.direction).normalized();
      const double part = along_m / kTrackingVaries_m;
      const auto node = static_cast<std::size_t>(part);
      const double beyond = part - static_cast<double>(node);
      points_m.push_back(place.at_m + 0.5 * options_.rod_diameter_m * out +
                         (1.0 - beyond) * tracking_m[node] + beyond * tracking_m[node + 1] +
                         sim::normal_vector(random_, options_.stroke_noise_m));
    }
  }
  return points_m;
}

/// `rod` becomes the bent rod; returns the final instructions.
nav::RodInstructions RodBench::followed(nav::RodInstructions told, const nav::RodBending& bending,
                                        double length_m, std::vector<nav::RodArc>& rod) {
  const nav::RodSpringBack spring_back =
      nav::RodSpringBack::of(bending.bender, bending.material, bending.diameter_m).value();
  const double stiffness = 1.0 + random_.normal(0.0, options_.spring_back_error);
  const bool strokes = options_.remeasured && told.bends.size() >= options_.measured_from_bends;
  std::vector<nav::RodArc> known;
  for (std::size_t k = 0; k < told.bends.size(); ++k) {
    rod.push_back(bent_as_told(told.bends[k], spring_back, stiffness));
    known.push_back(told.bends[k].arc);
    if (!strokes || k + 1 == told.bends.size()) {
      continue;
    }
    const auto points_m = stroked(rod, length_m);
    // If a stroke shows nothing, the bend is taken as instructed.
    const auto measured =
        nav::measured_bend(known, told.cut_length_m(), bending.diameter_m, points_m);
    known.back() = measured ? measured->arc : known.back();
    auto again = nav::rod_instructions_after(told, known, bending);
    if (again) {
      told = *std::move(again);
    }
  }
  return told;
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
  std::vector<nav::RodArc> bent;
  const nav::RodInstructions last = followed(*plan, bending, length_m, bent);
  const RodInHand rod = laid_rod(bent, length_m, last.fit);
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
