#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/transform.h"

namespace orthonav::nav::posterior {

/// A sample of the pointer's tip while it was stroked over the bone.
struct StrokePoint {
  Point<World> tip;
  int stroke = 0;       ///< which movement of the hand, ascending
  int area = 0;         ///< points without a leap between them; ascending
  double time_s = 0.0;  ///< ascending within a stroke; meaningless if not `Observations::in_time`
  Vec3 shaft{};         ///< unit, from the tip back along the pointer; zero if not known
};

/// The strokes over one bone, in World.
struct Observations {
  std::vector<StrokePoint> strokes;
  /// False where the points come without strokes and times, in any order: nothing is then known of
  /// how the hand's error wanders.
  bool in_time = true;
  double tip_radius_m = 0.0;  ///< of the ball at the pointer's end, whose centre is tracked
};

/// Observations from points in the order of time. A leap of more than 8 mm begins another area,
/// unless the tip is back within 15 points. With the time of each, a pause ends a stroke. Without,
/// they are 1/30 s apart, a stroke is an area, and where most steps are leaps the points are in no
/// order. A point within 0.05 mm of an earlier one is the same sample, repeated or resampled, and
/// is left out. `shafts` and `times_s`: of each point, or none; times that do not ascend tell
/// nothing.
[[nodiscard]] Observations observed(std::span<const Point<World>> points, double tip_radius_m,
                                    std::span<const Vec3> shafts = {},
                                    std::span<const double> times_s = {});

/// Consecutive points of a stroke that count as one row; of points in no order, those of one cell
/// of space. Depends on no pose, so that all hypotheses have the same.
struct Unit {
  int stroke = 0;
  int area = 0;
  std::vector<std::uint32_t> points;  ///< in `Observations::strokes`
  Vec3 quarter_m;                     ///< World: where its halves lie
  Vec3 three_quarters_m;
  double begin_s = 0.0;
  double end_s = 0.0;

  [[nodiscard]] Vec3 middle_m() const { return 0.5 * (quarter_m + three_quarters_m); }
};

/// About `most` units, each at least 4 mm long but for the last one of a stroke: of many short
/// strokes up to half as many more than there are strokes.
[[nodiscard]] std::vector<Unit> units_of(const Observations& observations, std::size_t most);

/// Eight consecutive points of a stroke, or of one cell of space: what they deviate from their mean
/// tells of the noise from point to point.
inline constexpr std::size_t kBlock = 8;
[[nodiscard]] std::vector<std::array<std::uint32_t, kBlock>> blocks_of(
    const Observations& observations, std::span<const Unit> units);

}  // namespace orthonav::nav::posterior
