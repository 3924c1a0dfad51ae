#pragma once

#include <memory>

#include "nav/geometry/mesh.h"
#include "render/scene.h"

namespace orthonav::engine {

/// The first lumbar vertebra of the Visible Human male (data/golden_vertebra.ply, © 2021 Robin
/// Remus, BSD-3-Clause), placed so that the entry points of the golden scenes lie on its pedicles.
/// LPS axes (+x left, +y posterior, +z superior), metres. For pictures alone; the scenes name it L4
/// as they name everything.
[[nodiscard]] std::shared_ptr<const render::MeshData> make_golden_vertebra();

/// The same as a model's mesh.
[[nodiscard]] nav::TriangleMesh golden_mesh();

/// Where a ray that comes from behind the patient, straight forwards, meets that vertebra.
[[nodiscard]] render::Float3 on_golden_vertebra(float x_m, float z_m);

}  // namespace orthonav::engine
