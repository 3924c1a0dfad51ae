#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/transform.h"
#include "nav/registration/pressed_places.h"
#include "nav/registration/registration.h"

namespace orthonav::nav {

/// When touched places of the bone confirm a registration: three that lie apart, not on one line,
/// each near the surface. What the fit itself says can't show that it was told the wrong thing;
/// three spread distances see every motion of a rigid body but those along the surface.
struct CheckPointRules {
  double apart_m = 0.015;  ///< each of the three from each other
  /// Of the surface, every check point; from 8 places on up to twice that.
  double within_m = 0.002;
  double off_line_m = 0.005;  ///< the least height of their triangle
  /// With a patient reference, places are asked for, up to so many in all, while 1 of 100 errors at
  /// the screws may exceed `wanted_tre_99_m` and the next place would reduce the expected error by
  /// at least this fraction
  /// (`least_gain`). After that the limits of any registration apply.
  std::size_t enough = 40;
  double wanted_tre_99_m = 0.001;
  double least_gain = 0.005;

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// More than so many say nothing new.
inline constexpr std::size_t kMostCheckPoints = 48;

/// A place of the bone, touched after the fit.
struct CheckPoint {
  Point<World> place;
  double distance_m = 0.0;  ///< of the registered surface; positive outside of the bone
  bool within = false;      ///< near enough
  double limit_m = CheckPointRules{}.within_m;  ///< of the distance, for `within`
};

/// `touched` against the part of the model that a pointer reaches: a lamina's far face must not
/// pass for its near one.
[[nodiscard]] CheckPoint check_point(const VertebraModel& model,
                                     const Transform<World, Vertebra>& world_from_vertebra,
                                     Point<World> touched, const CheckPointRules& rules = {});

/// Three places on the registered surface to touch, where the bone is known to be bare since it was
/// stroked there: as far apart as can be, and off one line. Fewer where the strokes allow no more.
[[nodiscard]] std::vector<Point<World>> places_to_check(
    const VertebraModel& model, const Transform<World, Vertebra>& world_from_vertebra,
    std::span<const Point<World>> stroked, const CheckPointRules& rules = {});

/// Those of them that no check point lies near, within 8 mm.
[[nodiscard]] std::vector<Point<World>> still_to_check(std::span<const Point<World>> places,
                                                       std::span<const CheckPoint> touched);

/// What is still to be done about check points.
struct CheckAdvice {
  enum class Kind : std::uint8_t {
    kNone,          ///< nothing: they confirm the registration
    kTouchApart,    ///< so many places, `value_m` apart from each other
    kTouchOffLine,  ///< one more place, `value_m` off the line of the others
    kReject,        ///< check point `number` lies `value_m` off the surface, above `limit_m`
    kTouchMore,     ///< one more place: 1 of 100 errors at the screws would exceed `value_m`
    kUncertain,     ///< as much would after the most places that count: reject
  };
  Kind kind = Kind::kNone;
  std::size_t number = 0;  ///< places to touch, or the check point, counted from 1
  double value_m = 0.0;
  double limit_m = 0.0;
};

struct CheckVerdict {
  bool passed = false;
  double worst_m = 0.0;  ///< the largest distance in size
  CheckAdvice advice;
};

/// Judges check points against a registration that took them in; they are the last of its places.
/// From 8 places on, one that agrees with the others may lie up to twice its limit off.
void weigh(const JoinedPlaces& joined, std::span<CheckPoint> points);
/// The verdict, where the registration that took them in must be certain at the screws as well.
/// `next`: what is worth touching after them.
[[nodiscard]] CheckVerdict verdict_on(std::span<const CheckPoint> points,
                                      const CheckPointRules& rules, const JoinedPlaces& joined,
                                      const std::optional<NextPlace>& next);

/// One check point too far off, wherever it lies, and none of the others helps.
[[nodiscard]] CheckVerdict verdict_on(std::span<const CheckPoint> points,
                                      const CheckPointRules& rules = {});

}  // namespace orthonav::nav
