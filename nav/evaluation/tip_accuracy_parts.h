#pragma once

#include <vector>

#include "nav/evaluation/tip_accuracy.h"

namespace orthonav::nav {

/// A pointer counts as held still for at least this long, and every part needs this many samples.
inline constexpr double kLeastStill_s = 2.0;
inline constexpr std::size_t kLeastStillSamples = 15;

/// The data that every part of the accuracy test uses; index i is the same moment in all lists.
struct PointerTrack {
  std::vector<TrackedPose> world_from_marker;
  std::vector<TipSample> tips;   ///< with the tip from the tool file
  std::vector<TipSample> fixed;  ///< the point of the tool that it turned about in the dimple
};

/// The dimple: where the pointer turned about its tip, and all samples that rested there.
struct Dimple {
  Vec3 offset_m{};                   ///< of the fixed point from the tip, in the marker's axes
  Vec3 point_m{};                    ///< in the world
  std::vector<std::size_t> samples;  ///< rising
};

/// The longest stretch of `dimple` in which the pointer was held still, its ends left out.
Result<std::vector<std::size_t>> still_stretch(const PointerTrack& track, const Dimple& dimple);

[[nodiscard]] SinglePointPart single_point_part(const PointerTrack& track, Point<Marker> tip,
                                                const std::vector<std::size_t>& still,
                                                const AccuracyOptions& options);

Result<TurningPart> turning_part(const PointerTrack& track, const ToolGeometry& pointer,
                                 const Dimple& dimple, const std::vector<std::size_t>& still,
                                 const AccuracyOptions& options);

Result<DistancePart> distance_part(const PointerTrack& track, const std::vector<TipRest>& touches,
                                   std::span<const Vec3> board_points_m,
                                   const AccuracyOptions& options);

[[nodiscard]] Judged judged(std::string what, double value_m, const AccuracyLimits& limits);
[[nodiscard]] std::vector<TipSample> picked(const std::vector<TipSample>& from,
                                            const std::vector<std::size_t>& indices);

}  // namespace orthonav::nav
