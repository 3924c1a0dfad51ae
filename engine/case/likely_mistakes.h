#pragma once

#include <span>
#include <string>

#include "base/result.h"
#include "nav/geometry/mesh.h"

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

}  // namespace orthonav::engine
