#pragma once

#include <string>
#include <vector>

#include "base/time.h"
#include "base/transform.h"

namespace orthonav::engine {

/// A place on a level's bone that can be found again by feel, such as a dimple made in it. Touched
/// before each screw, it shows whether the bone still lies where its registration says
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

/// When a landmark that is touched again counts as found in its place.
struct LandmarkRules {
  /// SD along an axis of a tip put into the same dimple again. Estimate.
  double dimple_sd_m = 0.0002;
  /// SD along an axis of tracking errors that last longer than a touch, so that averaging does not
  /// remove them: on the headset's map, and relative to a patient reference.
  double lasting_sd_m = 0.00035;
  double lasting_sd_anchored_m = 0.00005;
  /// How many touches make one place, with the tip lifted and put down again between them: on the
  /// headset's map a single one is too imprecise.
  int touches = 2;
  int touches_anchored = 1;
  /// The limit in SDs along an axis of the distance between two touches: one touch in 200 of a bone
  /// at rest exceeds it (chi-squared with three degrees of freedom).
  double sds = 3.583;
  /// The limit is never more than this, however badly the tip was seen: 95 of 100 shifts by 2 mm
  /// are detected.
  double most_m = 0.0014;
  /// On the headset's map: once World may have drifted by this SD along an axis since the bone was
  /// last found, nothing is guided before it is found again. By then one drift in twenty along an
  /// axis is longer than `most_m`.
  double most_walked_m = 0.0007;
  /// The least distance from the tag and the foot of a patient reference or, if the bone does not
  /// extend that far, `reach` times its extent: a clamp that turned moves nearby places least.
  double from_reference_m = 0.030;
  double reach = 0.8;

  [[nodiscard]] int touches_of(bool anchored) const {
    return anchored ? touches_anchored : touches;
  }
  /// Variance of one touch along an axis, beyond the scatter within its press.
  [[nodiscard]] double touch_variance_m2(bool anchored) const;
  /// SD along an axis of the distance between two places with these SDs, each the mean of its
  /// touches.
  [[nodiscard]] double distance_sd_m(double recorded_sd_m, double sd_m, bool anchored) const;
  /// The limit of a distance with this SD.
  [[nodiscard]] double limit_m(double distance_sd_m) const;
  /// The limit of the distance between two touches of one place.
  [[nodiscard]] double apart_m(double sd_m, bool anchored) const;
  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

}  // namespace orthonav::engine
