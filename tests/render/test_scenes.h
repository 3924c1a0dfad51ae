#pragma once

#include "render/scene.h"

namespace orthonav::render {

/// A white line, label 401.
[[nodiscard]] Scene line_scene(float width_m, Float3 from, Float3 to);
/// A sphere of 50 mm.
[[nodiscard]] Scene sphere_scene(MeshStyle style, Colour colour, Float3 at, Label label);
/// Everything at once, overlapping: veils 201 and 202, solids 301 and 302, lines 401 and 402,
/// triangles from 501 to 503, texts from 601 to 603. About one metre ahead.
[[nodiscard]] Scene crowded_scene();

}  // namespace orthonav::render
