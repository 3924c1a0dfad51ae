#pragma once

#include <cstddef>
#include <optional>

#include "nav/registration/pose_candidates.h"
#include "nav/registration/residual_field.h"

namespace orthonav::nav {

struct MarginalizedFit {
  SurfaceFit fit;
  std::optional<ResidualField> field;  ///< empty if a motion is undetermined
};

/// Fits all points, starting from a candidate's pose: robustly first, then with the correlation of
/// their heights, in at most `units` units. Empty if no point is near the surface.
[[nodiscard]] std::optional<MarginalizedFit> final_fit(const VertebraModel& model,
                                                       const Cloud& cloud, const SurfaceFit& start,
                                                       const PoseSearchRegistrationOptions& options,
                                                       std::size_t units = kMaxUnits);

/// The points' heights over the surface, with their weights, at a given pose and standoff (m). Only
/// the tip radius and the SDs of the points are used from the options.
[[nodiscard]] std::optional<SurfaceFit> fit_at(const VertebraModel& model,
                                               std::span<const Vec3> points_m,
                                               const CentredPose& pose, double standoff_m,
                                               const PoseSearchRegistrationOptions& options);

}  // namespace orthonav::nav
