#pragma once

#include "base/time.h"
#include "base/transform.h"

namespace orthonav::engine {

/// A place on a level's bone that can be found again by feel, such as a landmark made in it.
/// Touched before each screw, it shows whether the bone still lies where its registration says
/// (docs/decisions/0065-a-landmark-before-each-screw.md).
struct Landmark {
  Point<Vertebra> in_vertebra;  ///< where it was touched first, by the registration at that time
  double sd_m = 0.0;            ///< of that touch, along an axis
  Timestamp recorded{};
  /// Of the bone's offset from its registration at that time (BoneFound::sd_m).
  double bone_sd_m = 0.0;
};

/// How the landmark was found, by as many touches as needed.
struct LandmarkTouch {
  bool first = false;    ///< it recorded the landmark
  int missing = 0;       ///< touches still needed for a result
  double off_m = 0.0;    ///< from where it was recorded
  double limit_m = 0.0;  ///< beyond which something has moved
  double sd_m = 0.0;     ///< of the distance between the two places, along an axis
  [[nodiscard]] bool held() const { return missing == 0 && off_m <= limit_m; }
  [[nodiscard]] bool moved() const { return missing == 0 && !(off_m <= limit_m); }
};

/// SD along an axis of a tip put into the same landmark again. Estimate.
inline constexpr double kLandmarkSeatingSd_m = 0.0002;
/// SD along an axis of tracking errors that last longer than a touch, so that averaging does not
/// remove them: on the headset's map, and relative to a patient reference.
inline constexpr double kLastingSd_m = 0.00035;
inline constexpr double kLastingSdAnchored_m = 0.00005;
/// The limit in SDs along an axis of the distance between two touches: one touch in 200 of a bone
/// at rest exceeds it (chi-squared with three degrees of freedom).
inline constexpr double kLandmarkSds = 3.583;
/// The limit is never more than this, however badly the tip was seen: 95 of 100 shifts by 2 mm
/// are detected.
inline constexpr double kMaxLandmarkOff_m = 0.0014;
/// On the headset's map: once World may have drifted by this SD along an axis since the bone was
/// last found, nothing is guided before it is found again. By then one drift in twenty along an
/// axis is longer than `kMaxLandmarkOff_m`.
inline constexpr double kMaxWalked_m = 0.0007;
/// The least distance from the tag and the foot of a patient reference or, if the bone does not
/// extend that far, `kLandmarkReach` times its extent: a clamp that turned moves nearby places
/// least.
inline constexpr double kLandmarkFromReference_m = 0.030;
inline constexpr double kLandmarkReach = 0.8;

/// How many touches make one place, with the tip lifted and put down again between them: on the
/// headset's map a single one is too imprecise.
[[nodiscard]] constexpr int landmark_touches(bool anchored) { return anchored ? 1 : 2; }
/// Variance of one touch along an axis, beyond the scatter within its press.
[[nodiscard]] double landmark_variance_m2(bool anchored);
/// SD along an axis of the distance between two places with these SDs, each the mean of its
/// touches.
[[nodiscard]] double landmark_distance_sd_m(double recorded_sd_m, double sd_m, bool anchored);
/// The limit of a distance with this SD.
[[nodiscard]] double landmark_limit_m(double distance_sd_m);
/// The limit of the distance between two touches of one place.
[[nodiscard]] double landmark_apart_m(double sd_m, bool anchored);

}  // namespace orthonav::engine
