#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "nav/registration/model_error.h"
#include "nav/registration/registration.h"

namespace orthonav::nav {

// What pressed places say of a pose that strokes left uncertain. Height y of place p above the bone
// of the strokes' pose, and the step x from that pose to the true one, are jointly Gaussian:
//
//   y = - slope x + gap + f(p) + n        x = share f(strokes) + rest
//
// f is the model's error, a field over the bone: the strokes lay on the same wrong model, so that a
// press beside a stroke tells little. The gap beneath a tip has a part in common; n is tracking and
// tremor. Given f's SD and length, x given y is a Gaussian's conditional (Rasmussen & Williams
// 2006, section 2.7); over these it is summed, weighted by a prior and by the likelihood of y.

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
  /// Of places that a depth camera saw: SD of what it is off along its rays.
  double ray_sd_m = 0.0;
  /// SD along each axis of World's motion relative to the bone between the strokes and the first
  /// place; and from then on, which is included in the reported uncertainty, but not compared with
  /// the limits.
  double moved_sd_m = 0.0003;
  double since_sd_m = 0.0;
  /// False: fitted as if the model were exact. Its usual error is included in the reported
  /// uncertainty, but not compared with the limits.
  bool model_in_limits = true;
};

/// A pressed place, as far as its height depends on it, in the model's frame.
struct PressedHeight {
  Vec3 at_m;
  Vec3 up;   ///< unit, out of the bone
  Vec3 ray;  ///< unit, from a camera; zero: pressed
  int view = 0;
  double sd_m = 0.0;  ///< of this place alone, from tracking and tremor
};

/// The pose of strokes and presses, and what they say of the model.
struct PressFit {
  Vec3 centre_m;                        ///< of the step, in the model's frame
  std::array<double, 6> step{};         ///< translation m, rotation vector rad; of the points
  std::array<double, 36> covariance{};  ///< after the step, by rows
  std::array<double, 36> in_limits{};   ///< what the limits judge (`PressModel::model_in_limits`)
  /// For each place: its distance from the bone as predicted from all other places and the strokes
  /// (including SD and length of the field), and the SD of that.
  std::vector<double> off_m;
  std::vector<double> off_sd_m;
  double model_sd_m = 0.0;  ///< of the model's error, root mean square
  ModelError likeliest;     ///< that error; for what follows, it alone is used
  std::vector<PressedHeight> heights;

  /// The pose of the bone, given the pose from its strokes.
  [[nodiscard]] Transform<World, Vertebra> moved(
      const Transform<World, Vertebra>& world_from_vertebra) const;
};

/// Fits the step of the pose of `strokes`. Without places, the result is that of the strokes, with
/// the usual error of a model in place of what they tell of it: strokes take slow wandering of the
/// hand, and tissue, for an error of the model. Empty if `strokes` has no uncertainty or a number
/// is not finite.
[[nodiscard]] std::optional<PressFit> fit_presses(const VertebraModel& model,
                                                  const Registration& strokes,
                                                  std::span<const PressedPlace> places,
                                                  const PressModel& press);

/// The registration that includes pressed places, which were fitted with the same strokes: the pose
/// is by strokes and places together, and the uncertainty includes the model's own error.
/// `accepted`, `reasons` and `provisional` are judged again; everything else measured on the
/// strokes stays.
[[nodiscard]] Registration with_places(const VertebraModel& model, const Registration& strokes,
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
/// addition to `pressed`, of which `fit` is, at least `apart_m` from them. Empty if the strokes
/// hold no such place.
[[nodiscard]] std::optional<NextPlace> place_to_press(
    const VertebraModel& model, const Registration& strokes, std::span<const Point<World>> stroked,
    std::span<const PressedPlace> pressed, const PressFit& fit, const PressModel& press,
    const PoseSearchRegistrationOptions& options, double apart_m = kPressesApart_m);

}  // namespace orthonav::nav
