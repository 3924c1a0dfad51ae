#pragma once

#include <optional>
#include <span>
#include <vector>

#include "nav/registration/model_error.h"
#include "nav/registration/registration.h"

namespace orthonav::nav {

struct PressFit;

/// A place where the pointer's tip was pressed to the bone, or that a depth camera saw of it.
struct PressedPlace {
  Point<World> place;
  double sd_m = 0.0;    ///< of the tip's position along each axis: tracking and tremor
  double time_s = 0.0;  ///< since the bone was registered by its strokes
  Vec3 ray{};           ///< unit, World, from the camera; zero: it was pressed
  int view = 0;         ///< of the camera: what it is off, it is off in all of one view
};

/// Prior knowledge about such places.
struct PressModel {
  /// Height of the tip above the bone: mean, SD common to all places, SD of each place. Estimates
  /// for soft tissue under a pressed tip.
  double height_m = 0.0002;
  double common_sd_m = 0.0002;
  double sd_m = 0.0003;
  double tip_radius_m = 0.0;
  /// Of places that a depth camera saw: SD of what it is off along its rays.
  double ray_sd_m = 0.0;
  /// SD along each axis of World's motion relative to the bone between the strokes and the
  /// registration; and its random walk from then on, m/√s.
  double moved_sd_m = 0.0003;
  double drift_m_per_sqrt_s = 0.0;
  /// SD along each axis of its motion since the places were pressed, if the random walk is not part
  /// of the fit: included in the reported uncertainty, but not compared with the limits.
  double since_sd_m = 0.0;
  /// If known; otherwise it is estimated from the places, within the usual range of segmentations.
  std::optional<ModelError> model;
  /// The model's error where the fit takes it to be smaller than it is: included in the reported
  /// uncertainty, but not compared with the limits.
  std::optional<ModelError> left_out;
};

/// A registration that includes pressed places.
struct JoinedPlaces {
  Registration registration;
  /// For each place: its distance from the bone as predicted from all other places and the strokes,
  /// and the SD of that (leave one out).
  std::vector<double> off_m;
  std::vector<double> off_sd_m;
  ModelError model;  ///< as estimated from the places
};

/// Includes pressed places, which `fit_presses` has fitted with the same model and strokes, in a
/// registration: the pose is that of the bone, by strokes and places
/// together, at the time the last place was pressed, and the uncertainty includes the model's own
/// error. `accepted`, `reasons` and `provisional` are judged again; everything else measured on the
/// strokes stays. Empty without places. `targets` as for the registration.
[[nodiscard]] std::optional<JoinedPlaces> join_places(const VertebraModel& model,
                                                      const Registration& strokes,
                                                      const PressFit& fit, const PressModel& press,
                                                      const PoseSearchRegistrationOptions& options);

/// A place that is worth pressing.
struct NextPlace {
  Point<World> place;
  /// Root mean square error to expect at the worst target, now and after this place is pressed.
  double tre_m = 0.0;
  double tre_then_m = 0.0;
};

/// Two places nearer to each other than this add little more than one.
inline constexpr double kPressesApart_m = 0.003;

/// The place on the stroked bone that reduces the error at the worst target most if pressed in
/// addition to `pressed`, of which `fit` is, at least `apart_m` from them. Empty if none reduces
/// it.
[[nodiscard]] std::optional<NextPlace> place_to_press(
    const VertebraModel& model, const Registration& strokes, std::span<const Point<World>> stroked,
    std::span<const PressedPlace> pressed, const PressFit& fit, const PressModel& press,
    const PoseSearchRegistrationOptions& options, double apart_m = kPressesApart_m);

}  // namespace orthonav::nav
