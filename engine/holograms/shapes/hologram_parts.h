#pragma once

#include <initializer_list>
#include <memory>
#include <span>
#include <string_view>

#include "engine/holograms/shapes/hologram_shapes.h"

namespace orthonav::engine {

// Parts from which holograms are composed.

/// The size of numbers that are not sure, and of words beside numbers, in the size of sure ones. A
/// paler text alone would not do: with the contrast that every text needs, it is hardly paler.
inline constexpr float kUnsureSize = 0.8f;

[[nodiscard]] render::Colour faded(render::Colour colour, float opacity);

void add_mesh(render::Scene& scene, std::shared_ptr<const render::MeshData> mesh,
              const render::Matrix4& world_from_model, render::Colour colour, render::Label label);

void add_sphere(render::Scene& scene, render::Float3 centre, float radius_m, render::Colour colour,
                render::Label label);

void add_line(render::Scene& scene, std::span<const render::Float3> points, float width_m,
              render::Colour colour, render::Label label, float dash_m = 0, bool closed = false);
inline void add_line(render::Scene& scene, std::initializer_list<render::Float3> points,
                     float width_m, render::Colour colour, render::Label label, float dash_m = 0,
                     bool closed = false) {
  add_line(scene, std::span(points.begin(), points.size()), width_m, colour, label, dash_m, closed);
}

void add_ring(render::Scene& scene, render::Float3 centre, render::Float3 normal, float radius_m,
              float width_m, render::Colour colour, render::Label label, int points = 48);

/// A text beside a place, vertically centred on it: offset to the right by this many of its
/// heights, or to the left if negative. The caller adds its words to the returned item.
render::TextItem& add_text_beside(render::Scene& scene, render::Float3 place, float offset_right,
                                  float height_m, float min_height_deg, render::Label label);
void add_run(render::TextItem& item, std::string_view text, render::Colour colour);
/// Adds an empty run, to be filled by the caller.
[[nodiscard]] std::string& add_run(render::TextItem& item, render::Colour colour);

}  // namespace orthonav::engine
