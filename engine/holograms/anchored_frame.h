#pragma once

#include <vector>

#include "base/transform.h"
#include "engine/holograms/labels/glare_patches.h"
#include "engine/session/shown_frame.h"
#include "render/scene.h"

namespace orthonav::engine {

// Converts a scene or frame built in the anchored World (nav/tracking/anchored_tracker.h) to the
// headset's map, in place. Items fixed to the head stay. Nothing allocates.

void take_to_map(const Transform<World, World>& world_from_anchored, render::Scene& scene);
void take_to_map(const Transform<World, World>& world_from_anchored, ShownFrame& frame);
void take_to_map(const Transform<World, World>& world_from_anchored,
                 std::vector<GlarePatch>& patches);

}  // namespace orthonav::engine
