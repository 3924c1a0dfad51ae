#pragma once

#include <optional>
#include <span>
#include <vector>

#include "nav/registration/model_error.h"
#include "nav/registration/registration.h"

namespace orthonav::nav {

struct PressFit;

/// A place where the pointer's tip was pressed to the bone.
struct PressedPlace {
  Point<World> place;
  double sd_m = 0.0;    ///< of the tip's place, along an axis: tracking and tremor
  double time_s = 0.0;  ///< since the bone was registered by its strokes
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
  /// SD along each axis by which it moved since they were pressed, where the walk is not in the
  /// fit: told with the uncertainty, and not held against the limits.
  double since_sd_m = 0.0;
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
/// The same, of places that `fit_presses` took in with the same model and strokes.
[[nodiscard]] std::optional<JoinedPlaces> join_places(const VertebraModel& model,
                                                      const Registration& strokes,
                                                      const PressFit& fit, const PressModel& press,
                                                      const PoseSearchRegistrationOptions& options);

/// A place that is worth pressing.
struct NextPlace {
  Point<World> place;
  /// Root mean square error to expect at the worst target, as it is and once it was pressed.
  double tre_m = 0.0;
  double tre_then_m = 0.0;
};

/// Nearer to each other, two places tell little more than one.
inline constexpr double kPressesApart_m = 0.005;

/// Of the bone that was stroked, the place that takes most of the error at the worst target away
/// when it is pressed besides those that were, at least `apart_m` from them. Nothing where none
/// would.
[[nodiscard]] std::optional<NextPlace> place_to_press(
    const VertebraModel& model, const Registration& strokes, std::span<const Point<World>> stroked,
    std::span<const PressedPlace> pressed, const PoseSearchRegistrationOptions& options,
    const PressModel& press = {}, double apart_m = kPressesApart_m);
/// The same, of `pressed` places that `fit_presses` took in with the same model and strokes.
[[nodiscard]] std::optional<NextPlace> place_to_press(
    const VertebraModel& model, const Registration& strokes, std::span<const Point<World>> stroked,
    std::span<const PressedPlace> pressed, const PressFit& fit, const PressModel& press,
    const PoseSearchRegistrationOptions& options, double apart_m = kPressesApart_m);

}  // namespace orthonav::nav
