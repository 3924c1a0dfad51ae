#pragma once

#include <optional>
#include <span>

#include "nav/geometry/mesh.h"
#include "nav/guidance/screw.h"

namespace orthonav::nav {

struct ScrewError {
  double angle_rad = 0.0;         ///< between planned and executed trajectory
  std::optional<double> entry_m;  ///< planned to executed entry; absent if it misses the bone
};

/// The executed entry is the first intersection of the executed trajectory with the model (Liebmann
/// et al. 2019, section 4). `executed.direction` points into the bone.
[[nodiscard]] ScrewError screw_error(const ScrewPlan& plan, const Axis<Vertebra>& executed,
                                     const SurfaceIndex& model);

/// All zero without values; `sd` is 0 for a single one.
struct Summary {
  std::size_t count = 0;
  double mean = 0.0;
  double sd = 0.0;  ///< of the sample (n - 1)
  double min = 0.0;
  double max = 0.0;
};
[[nodiscard]] Summary summarize(std::span<const double> values);

}  // namespace orthonav::nav
