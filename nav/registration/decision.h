#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/transform.h"
#include "nav/registration/posterior.h"
#include "nav/registration/registration.h"

namespace orthonav::nav::posterior {

/// What is asked of the points: where the pose must be certain, how certain, and what else they may
/// be of.
struct Question {
  /// Where the pose must be certain, at least one: the entries and targets of the plan.
  std::vector<Point<Vertebra>> targets;
  std::vector<NeighbourLevel> neighbours;
  Prior prior;
  double most_m = 0.002;  ///< an error at any target above it is wrong
};

/// The most probability of a wrong pose.
inline constexpr double kMayBeWrong = 0.01;
/// A model farther from the bone's size is wrong.
inline constexpr double kMaxSizeOff = 0.015;

/// How far apart two poses put the farthest of the targets.
[[nodiscard]] double apart_m(const Transform<World, Vertebra>& a,
                             const Transform<World, Vertebra>& b,
                             std::span<const Point<Vertebra>> targets);

/// Fraction of the points at which, in this pose, the pointer's shaft would have gone through bone:
/// the space that the pointer occupied must be free. A point whose shaft is not known does not
/// count. 0 without points. Looks at a few hundred of them.
[[nodiscard]] double shaft_collision_fraction(const Observations& observations,
                                              const VertebraModel& model,
                                              const Transform<World, Vertebra>& world_from_vertebra,
                                              bool mirrored = false);

/// One explanation of the points, and its probability among all that were tried.
struct Explanation {
  enum class Kind : std::uint8_t { kAnswer, kOtherPose, kLevel, kMirror, kSize };
  Kind kind = Kind::kAnswer;
  std::string level;  ///< of kLevel
  double probability = 0.0;
  double wrong = 0.0;      ///< probability that the answer is wrong if this is so
  double log_ratio = 0.0;  ///< of its evidence to the answer's, without odds
  Transform<World, Vertebra> world_from_vertebra;
};

struct Decision {
  Posterior answer;
  std::vector<Explanation> explanations;  ///< the answer first
  double wrong = 1.0;                     ///< probability that the answer is wrong
  double inlier_fraction = 0.0;
  double shaft_collision_fraction = 0.0;
  bool accepted = false;
  /// Of the error at the worst target: root mean square under the answer, and what 95 and 99 of 100
  /// errors stay below under all poses of the bone.
  double rms_m = 0.0;
  double within_95_m = 0.0;
  double within_99_m = 0.0;
};

/// Compares all explanations of the points. Refuses points that can't be registered at all: fewer
/// than 100, not finite, spread too widely, on a line, or such that no pose is found.
[[nodiscard]] Result<Decision> decided(const VertebraModel& model, const Observations& observations,
                                       const Question& question);

}  // namespace orthonav::nav::posterior
