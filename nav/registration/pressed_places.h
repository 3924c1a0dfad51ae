#pragma once

#include <optional>
#include <span>
#include <vector>

#include "nav/registration/posterior.h"
#include "nav/registration/registration.h"

namespace orthonav::nav {

/// A place where the pointer's tip was pressed to the bone.
struct PressedPlace {
  Point<World> place;
  double sd_m = 0.0;    ///< of the tip's position along each axis: tracking and tremor
  double time_s = 0.0;  ///< since the bone was registered by its strokes
};

/// SDs along each axis of World's motion relative to the bone.
struct MotionOfWorld {
  double before_m = posterior::Prior{}.moved_sd_m;  ///< between the strokes and the places
  /// Since the places were pressed: included in the reported uncertainty, but not compared with the
  /// limits, because no press can reduce it.
  double since_m = 0.0;
};

/// A registration that includes pressed places.
struct JoinedPlaces {
  Registration registration;
  posterior::Joined joined;
};

/// Includes pressed places in a registration of strokes: the pose is that of the bone under the
/// places. `accepted`, `reasons` and `provisional` are judged again by the errors that are left;
/// everything else measured on the strokes stays. Of a registration without its `strokes` only pose
/// and covariance count. Empty where it has no `uncertainty`, or a number is not finite. `options`:
/// targets and limits.
[[nodiscard]] std::optional<JoinedPlaces> join_places(const VertebraModel& model,
                                                      const Registration& strokes,
                                                      std::span<const PressedPlace> places,
                                                      const PoseSearchRegistrationOptions& options,
                                                      const MotionOfWorld& motion = {});

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
/// addition to `pressed`, which are joined already, at least `apart_m` from them. Empty if none
/// reduces it.
[[nodiscard]] std::optional<NextPlace> place_to_press(const VertebraModel& model,
                                                      const JoinedPlaces& joined,
                                                      std::span<const Point<World>> stroked,
                                                      std::span<const PressedPlace> pressed,
                                                      const PoseSearchRegistrationOptions& options,
                                                      double apart_m = kPressesApart_m);

}  // namespace orthonav::nav
