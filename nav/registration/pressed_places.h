#pragma once

#include <optional>
#include <span>
#include <vector>

#include "nav/registration/registration.h"

namespace orthonav::nav {

/// A place where the pointer's tip was pressed to the bone.
struct PressedPlace {
  Point<World> place;
  double sd_m = 0.0;    ///< of the tip's place, along an axis: tracking and tremor
  double time_s = 0.0;  ///< since the bone was registered by its strokes
};

/// Of a model about the bone that it was made of: segmentation.
struct ModelError {
  double sd_m = 0.0;
  double length_m = 0.007;  ///< alike over it: covariance `sd² exp(-distance / length)`
};

/// What is known of such places before any is touched.
struct PressModel {
  /// Of the tip above the bone: mean, SD in common, SD of each. Estimates: soft tissue under a tip
  /// that is pressed.
  double height_m = 0.0002;
  double common_sd_m = 0.0002;
  double sd_m = 0.0003;
  double tip_radius_m = 0.0;
  /// SD along each axis by which World may have moved against the bone since it was stroked, until
  /// it was registered; and how it walks from then on, m/√s.
  double moved_sd_m = 0.0003;
  double drift_m_per_sqrt_s = 0.0;
  /// Where it is known; otherwise the places themselves tell, within what segmentations are.
  std::optional<ModelError> model;
};

/// A registration with pressed places taken in.
struct JoinedPlaces {
  Registration registration;
  /// Of each place: how far off the bone it lies by all that the others and the strokes tell, and
  /// the SD of that (leave one out).
  std::vector<double> off_m;
  std::vector<double> off_sd_m;
  ModelError model;  ///< as the places tell it
};

/// Takes pressed places into a registration: its pose is where the strokes and the places together
/// put the bone when the last of them was pressed, with what remains uncertain, the model's own
/// error among it. Its `accepted`, `reasons` and `provisional` are judged anew; what else was
/// measured on the strokes stays. Nothing where the strokes leave a motion open. `targets` as for
/// the registration.
[[nodiscard]] std::optional<JoinedPlaces> join_places(const VertebraModel& model,
                                                      const Registration& strokes,
                                                      std::span<const PressedPlace> places,
                                                      const PoseSearchRegistrationOptions& options,
                                                      const PressModel& press = {});

/// A place that is worth pressing.
struct NextPlace {
  Point<World> place;
  /// Root mean square error to expect at the worst target, as it is and once it was pressed.
  double tre_m = 0.0;
  double tre_then_m = 0.0;
};

/// Of the bone that was stroked, the place that takes most of the error at the worst target away
/// when it is pressed besides those that were, at least `apart_m` from them. Nothing where none
/// would.
[[nodiscard]] std::optional<NextPlace> place_to_press(
    const VertebraModel& model, const Registration& strokes, std::span<const Point<World>> stroked,
    std::span<const PressedPlace> pressed, const PoseSearchRegistrationOptions& options,
    const PressModel& press = {}, double apart_m = 0.005);

}  // namespace orthonav::nav
