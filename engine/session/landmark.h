#pragma once

#include <string>
#include <vector>

#include "base/time.h"
#include "base/transform.h"

namespace orthonav::engine {

/// A place of a level's bone that is found again by feel, such as a dimple made in it. Touched
/// before each screw, it tells whether the bone still lies where its registration says
/// (docs/decisions/0065-a-landmark-before-each-screw.md).
struct Landmark {
  Point<Vertebra> in_vertebra;  ///< where it was touched first, by the registration of that moment
  double sd_m = 0.0;            ///< of that touch, along an axis
  Timestamp recorded{};
  /// By which the bone may have been off its registration at that moment (BoneFound::sd_m).
  double bone_sd_m = 0.0;
};

/// How it was found, by as many touches as it takes.
struct LandmarkTouch {
  bool first = false;    ///< it recorded the landmark
  int missing = 0;       ///< touches still to come, before which nothing is known
  double off_m = 0.0;    ///< from where it was recorded
  double limit_m = 0.0;  ///< beyond which something has moved
  double sd_m = 0.0;     ///< of the distance between the two places, along an axis
  [[nodiscard]] bool held() const { return missing == 0 && off_m <= limit_m; }
  [[nodiscard]] bool moved() const { return missing == 0 && !(off_m <= limit_m); }
};

/// When a landmark that is touched again counts as found where it was.
struct LandmarkRules {
  /// SD along an axis of a tip put into the same dimple again. Estimate.
  double dimple_sd_m = 0.0002;
  /// SD along an axis by which tracking is off for longer than a touch lasts, so that its mean does
  /// not show it: on the headset's map, and relative to a patient reference.
  double lasting_sd_m = 0.00035;
  double lasting_sd_anchored_m = 0.00005;
  /// So many touches make one place, lifted and put down again between them: on the headset's map
  /// one alone tells too little.
  int touches = 2;
  int touches_anchored = 1;
  /// The limit is so many SDs of the distance between two touches along an axis: one touch in 200
  /// of a bone at rest lies beyond (chi-squared with three degrees of freedom).
  double sds = 3.583;
  /// And never more than this, however badly the tip was seen: of shifts by 2 mm, 95 of 100 show.
  double most_m = 0.0014;
  /// On the headset's map: once World may have walked by this SD along an axis since the bone was
  /// last found, nothing is guided before it is found again. By then one in twenty walks along an
  /// axis is longer than `most_m`.
  double most_walked_m = 0.0007;
  /// So far from the tag and the foot of a patient reference, or, where the bone does not reach so
  /// far, `reach` of as far as it does: a clamp that turned moves what is near it least.
  double from_reference_m = 0.030;
  double reach = 0.8;

  [[nodiscard]] int touches_of(bool anchored) const {
    return anchored ? touches_anchored : touches;
  }
  /// Of one touch along an axis, besides what its press tells of itself.
  [[nodiscard]] double touch_variance_m2(bool anchored) const;
  /// SD along an axis of the distance between two places of these SDs, each of so many touches.
  [[nodiscard]] double distance_sd_m(double recorded_sd_m, double sd_m, bool anchored) const;
  /// Of a distance with this SD.
  [[nodiscard]] double limit_m(double distance_sd_m) const;
  /// Of the distance between two touches of one place: farther apart, they are not one.
  [[nodiscard]] double apart_m(double sd_m, bool anchored) const;
  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

}  // namespace orthonav::engine
