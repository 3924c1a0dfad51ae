#pragma once

#include <optional>
#include <span>

#include "engine/evaluation/shaft.h"

namespace orthonav::engine {

/// A shaft to a fraction of a voxel: place, direction, bow (of a thin one), radius, ends and blur
/// such that a cylinder of one density, blurred as by the scanner and averaged over each voxel,
/// explains the voxels about its border (Levenberg-Marquardt). Both sides are cut off below, where
/// bone and streaks are, and above, where a 12-bit scan clips: so only the flank of the metal
/// counts, which lies the same way on all sides of an axis. The density of clipped metal is not
/// seen: of a shaft of 3.6 mm and less it is taken for steel, else for titanium; what is denser
/// looks 0.1 to 0.3 mm thicker than it is. Of a long wire the front 55 mm are fitted. `others` are
/// left out of it. Nothing where the fit leaves the shaft.
[[nodiscard]] std::optional<Shaft> fitted_shaft(const ScanField& scan, const Shaft& found_shaft,
                                                std::span<const Shaft> others);

}  // namespace orthonav::engine
