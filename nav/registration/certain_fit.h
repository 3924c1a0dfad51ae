#pragma once

#include <cstddef>
#include <optional>

#include "nav/registration/pose_candidates.h"
#include "nav/registration/residual_field.h"

namespace orthonav::nav {

struct CertainFit {
  SurfaceFit fit;
  std::optional<ResidualField> field;  ///< nothing where a motion is undetermined
};

/// Fits all points, starting from a candidate's pose: robustly, then with what their heights have
/// in common, told by so many units. Nothing where no point is near the surface.
[[nodiscard]] std::optional<CertainFit> final_fit(const VertebraModel& model, const Cloud& cloud,
                                                  const SurfaceFit& start,
                                                  const PoseSearchRegistrationOptions& options,
                                                  std::size_t units = kMostUnits);

}  // namespace orthonav::nav
