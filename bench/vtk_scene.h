#pragma once

#include <vtkRenderer.h>

#include "render/scene.h"

namespace orthonav::bench {

/// The scene's items as VTK's actors.
void add_scene(const render::Scene& scene, const render::View& view, vtkRenderer& renderer);
/// The camera of a view; its frustum must be symmetric.
void set_camera(const render::View& view, vtkRenderer& renderer);

}  // namespace orthonav::bench
