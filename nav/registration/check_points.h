#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/transform.h"
#include "nav/registration/presses.h"
#include "nav/registration/registration.h"

namespace orthonav::nav {

/// When touched places of the bone confirm a registration: three places apart from each other, not
/// on one line, each near the surface. The fit itself can't show that its data were wrong; three
/// spread distances reveal every motion of a rigid body except along the surface.
struct CheckPointRules {
  double apart_m = 0.015;  ///< least distance between any two of the three
  /// The largest distance of every check point from the surface; from 8 places on up to twice that.
  double within_m = 0.002;
  double off_line_m = 0.005;  ///< the least height of their triangle
  /// With a patient reference, more places are asked for, up to this many in all, while 1 of 100
  /// errors at the screws may exceed `wanted_tre_99_m` and the next place would reduce the expected
  /// error by at least the fraction `least_gain`. After that the limits of any registration apply.
  std::size_t enough = 25;
  double wanted_tre_99_m = 0.0008;
  double least_gain = 0.002;

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// More places than this add nothing.
inline constexpr std::size_t kMaxCheckPoints = 48;

/// A place of the bone, touched after the fit.
struct CheckPoint {
  Point<World> place;
  double distance_m = 0.0;  ///< from the registered surface; positive outside the bone
  bool within = false;      ///< near enough
  double limit_m = CheckPointRules{}.within_m;  ///< of the distance, for `within`
};

/// Compares `touched` with the part of the model that a pointer can reach, so that a lamina's far
/// face is not taken for its near one.
[[nodiscard]] CheckPoint check_point(const VertebraModel& model,
                                     const Transform<World, Vertebra>& world_from_vertebra,
                                     Point<World> touched, const CheckPointRules& rules = {});

/// Three places on the registered surface to touch, where the bone is known to be exposed because
/// it was stroked there: as far apart as possible, and not on one line. Fewer if the strokes allow
/// no more.
[[nodiscard]] std::vector<Point<World>> places_to_check(
    const VertebraModel& model, const Transform<World, Vertebra>& world_from_vertebra,
    std::span<const Point<World>> stroked, const CheckPointRules& rules = {});

/// Those of them without a check point within 8 mm.
[[nodiscard]] std::vector<Point<World>> still_to_check(std::span<const Point<World>> places,
                                                       std::span<const CheckPoint> touched);

/// What is still to be done about check points.
struct CheckAdvice {
  enum class Kind : std::uint8_t {
    kNone,          ///< nothing more: they confirm the registration
    kTouchApart,    ///< `number` places, `value_m` apart from each other
    kTouchOffLine,  ///< one more place, `value_m` off the line of the others
    kReject,        ///< check point `number` lies `value_m` off the surface, above `limit_m`
    kTouchMore,     ///< one more place: 99 % of errors at the screws are below `value_m`
    kUncertain,     ///< the same is true after the largest number of places: reject
  };
  Kind kind = Kind::kNone;
  std::size_t number = 0;  ///< places to touch, or the check point, counted from 1
  double value_m = 0.0;
  double limit_m = 0.0;
};

struct CheckVerdict {
  bool passed = false;
  double worst_m = 0.0;  ///< the largest distance in magnitude
  CheckAdvice advice;
};

/// Judges check points against a fit that includes them; they are the last of its places.
/// From 8 places on, one that agrees with the others may be off by up to twice its limit.
void weigh(const PressFit& fit, std::span<CheckPoint> points);
/// The verdict if the registration that includes them must also be certain at the screws. `next`:
/// what is worth touching after them.
[[nodiscard]] CheckVerdict verdict_on(std::span<const CheckPoint> points,
                                      const CheckPointRules& rules, const Registration& with_them,
                                      const std::optional<NextPlace>& next);

/// The verdict on check points alone: a single one that is too far off is enough to reject.
[[nodiscard]] CheckVerdict verdict_on(std::span<const CheckPoint> points,
                                      const CheckPointRules& rules = {});

/// The surface that the strokes left out, one value per vertex of the model's mesh: 1 where a
/// pointer could have stroked but no point lies within 6 mm, 0 where a point lies within 4 mm or
/// the pointer can't reach, and proportional in between. Where it is 1 the registration is an
/// inference, not a measurement.
[[nodiscard]] std::vector<float> unstroked_surface(
    const VertebraModel& model, const Transform<World, Vertebra>& world_from_vertebra,
    std::span<const Point<World>> points);

}  // namespace orthonav::nav
