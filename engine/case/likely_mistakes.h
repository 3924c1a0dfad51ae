#pragma once

#include <span>
#include <string>

#include "base/result.h"
#include "nav/geometry/mesh.h"
#include "nav/guidance/screw.h"

namespace orthonav::engine {

// What people get wrong about axes, units and levels, told by the geometry alone: one place for all
// commands. Each Error names the mistake and the remedy, and follows a file's name.

/// Whether a vertebral canal is found. Refuses a vertebra in which it is found only once the model
/// is turned half round the patient's long axis: RAS that was taken for LPS, or the other way
/// round.
Result<bool> has_canal(const nav::TriangleMesh& vertebra);

/// Refuses points that all lie within 1 mm, though there are several, or farther apart than 10 m:
/// in metres taken for millimetres, or the other way round. `unit_stated`: by the file itself.
Status check_scale(std::span<const Vec3> points_m, bool unit_stated);

/// The level that a file's name states, "L4" for `cases/left L4.mrk.json`; empty if it states none,
/// or several.
[[nodiscard]] std::string level_in_name(const std::string& path);

/// What indicates that screws were planned on another vertebra, though they lie within the limits
/// of `misplaced`: "left entry 2.6 mm below the surface, limit 2.0 mm; right breaks through the
/// cortex by 1.2 mm". Empty where nothing does, which proves little: of plans for a neighbouring
/// level, each in its own frame, three in ten fit.
[[nodiscard]] std::string poor_fit(const nav::TriangleMesh& vertebra,
                                   std::span<const nav::ScrewPlan> screws);

}  // namespace orthonav::engine
