#pragma once

#include "render/scene.h"

namespace orthonav::engine {

/// H8: a copy of the surroundings of a site, beside it and twice as large, in the patient's
/// orientation.
struct VirtualTwin {
  render::Float3 site{};    ///< not moved apart from the shift
  render::Float3 beside{};  ///< unit, which way the twin is shifted
};

inline constexpr float kTwinScale = 2.0f;
inline constexpr float kTwinBeside_m = 0.150f;

/// Where a place lies in the twin.
[[nodiscard]] render::Float3 in_twin(const VirtualTwin& twin, render::Float3 place);

/// A tool from its tip 80 mm along its axis, in white.
void add_tool(render::Scene& scene, render::Float3 tip, render::Float3 axis, render::Label label);

/// Adds copies of the surfaces, lines and triangles of `parts` to a scene, all under one label;
/// texts are not copied.
void add_twin(render::Scene& scene, const VirtualTwin& twin, const render::Scene& parts,
              render::Label label);

}  // namespace orthonav::engine
