#pragma once

#include <span>
#include <vector>

#include "engine/holograms/glare_patches.h"
#include "engine/holograms/label_geometry.h"
#include "render/scene.h"

namespace orthonav::engine {

/// Something that labels make way for.
struct LabelObstacle {
  enum class Kind {
    kNamed,   ///< what labels name: none may cover it
    kGlare,   ///< no number that guides may lie on it, and others only if what they name does
    kLine,    ///< labels rather stand elsewhere
    kWound,   ///< no number that guides may cover it
    kLeader,  ///< leads to a label
  };
  Kind kind = Kind::kNamed;
  render::Label label = 0;  ///< the hologram that it belongs to; 0: none
  OutlineInEyes seen;
};

/// The entry that is being guided to, and what lies around it.
inline constexpr float kWoundRadius_m = 0.012f;

/// What a scene's labels must not cover, in place of what `obstacles` held: the anchors of all
/// labels, target cross, rods, planned trajectory and triangle, patches. Texts are no part of it.
void find_obstacles(const render::Scene& scene, std::span<const GlarePatch> patches,
                    const Eyes& eyes, std::vector<LabelObstacle>& obstacles);

}  // namespace orthonav::engine
