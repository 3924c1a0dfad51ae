#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/hologram_shapes.h"

namespace orthonav::engine {

// What holograms are put together from.

[[nodiscard]] render::Colour faded(render::Colour colour, float opacity);

void add_mesh(render::Scene& scene, std::shared_ptr<const render::MeshData> mesh,
              const render::Matrix4& world_from_model, render::Colour colour, render::Label label);

void add_sphere(render::Scene& scene, render::Float3 centre, float radius_m, render::Colour colour,
                render::Label label);

void add_line(render::Scene& scene, std::vector<render::Float3> points, float width_m,
              render::Colour colour, render::Label label, float dash_m = 0, bool closed = false);

/// A text beside a place, its middle as high: to the right by so many of its heights, or to the
/// left where that is negative.
void add_text_beside(render::Scene& scene, render::Float3 place, float offset_right, float height_m,
                     float min_height_deg, std::vector<render::TextRun> runs, render::Label label);

}  // namespace orthonav::engine
