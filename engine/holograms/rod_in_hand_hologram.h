#pragma once

#include <memory>

#include "engine/session/rod_in_hand.h"
#include "render/scene.h"

namespace orthonav::engine {

/// H10 of the rod in hand, where it was stroked: its outline and axis, a ring at the middle of the
/// next bend with its text, an arrow to where the far end goes, and where to cut it. Make `tube`
/// once per stroked rod and keep it: the renderer caches by pointer.
void add_rod_in_hand(render::Scene& scene, const LyingRod& rod,
                     std::shared_ptr<const render::MeshData> tube, render::Label label);

/// The surface of the rod.
[[nodiscard]] std::shared_ptr<const render::MeshData> tube_of(const LyingRod& rod);

}  // namespace orthonav::engine
