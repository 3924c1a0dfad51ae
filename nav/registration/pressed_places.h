#pragma once

#include <optional>
#include <span>
#include <vector>

#include "nav/registration/registration.h"

namespace orthonav::nav {

/// A place where the pointer's tip was pressed to the bone.
struct PressedPlace {
  Point<World> place;
  double sd_m = 0.0;  ///< of the tip's place, along an axis: tracking and tremor
};

/// What is known of such places before any is touched.
struct PressModel {
  /// Of the tip above the bone: mean, SD in common, SD of each. Estimates: soft tissue under a tip
  /// that is pressed.
  double height_m = 0.0002;
  double common_sd_m = 0.0002;
  double sd_m = 0.0003;
  double tip_radius_m = 0.0;
  /// SD along each axis by which World may have moved against the bone since it was stroked.
  double moved_sd_m = 0.0003;
  /// And since they were pressed, until now.
  double moved_since_sd_m = 0.0;
};

/// A registration with pressed places taken in.
struct JoinedPlaces {
  Registration registration;
  /// Of each place: how far off the bone it lies by all that the others and the strokes tell, and
  /// the SD of that (leave one out).
  std::vector<double> off_m;
  std::vector<double> off_sd_m;
};

/// Takes pressed places into a registration: its pose is where the strokes and the places together
/// put the bone now (iterated Kalman update; Bell & Cathey 1993), with what remains uncertain. Its
/// `accepted`, `reasons` and `provisional` are judged anew; what else was measured on the strokes
/// stays. Nothing where the strokes leave a motion open. `targets` as for the registration.
[[nodiscard]] std::optional<JoinedPlaces> join_places(const VertebraModel& model,
                                                      const Registration& strokes,
                                                      std::span<const PressedPlace> places,
                                                      const PoseSearchRegistrationOptions& options,
                                                      const PressModel& press = {});

/// Of the bone that was stroked, the place that takes most of the error at the worst target away
/// when it is pressed, at least `apart_m` from those that were. Nothing where none would.
[[nodiscard]] std::optional<Point<World>> place_to_press(
    const VertebraModel& model, const Registration& joined, std::span<const Point<World>> stroked,
    std::span<const PressedPlace> pressed, const PoseSearchRegistrationOptions& options,
    double apart_m = 0.006);

}  // namespace orthonav::nav
