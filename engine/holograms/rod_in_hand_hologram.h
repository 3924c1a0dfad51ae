#pragma once

#include <memory>

#include "engine/holograms/hologram_label.h"
#include "engine/session/rod_in_hand.h"
#include "render/scene.h"

namespace orthonav::engine {

/// Of everything that add_rod_in_hand adds; 1 and 2 are the templates of the left and the right
/// rod.
inline constexpr render::Label kRodInHandLabel = label_of(HologramKind::kRod, 3);

/// H10 of the rod in hand, where it was stroked: its outline and axis, a ring at the middle of the
/// next bend with its text, an arrow to where the far end goes, and where to cut it. Make `tube`
/// once per stroked rod and keep it: the renderer caches by pointer.
void add_rod_in_hand(render::Scene& scene, const LyingRod& rod,
                     std::shared_ptr<const render::MeshData> tube);

/// The surface of the rod.
[[nodiscard]] std::shared_ptr<const render::MeshData> tube_of(const LyingRod& rod);

}  // namespace orthonav::engine
