#pragma once

#include <span>
#include <vector>

#include "engine/holograms/labels/glare_patches.h"
#include "engine/holograms/labels/label_geometry.h"
#include "render/scene.h"

namespace orthonav::engine {

/// Something that labels avoid.
struct LabelObstacle {
  enum class Kind {
    kNamed,   ///< named by a label: no label may cover it
    kGlare,   ///< labels lie on it only if the thing they name does
    kLine,    ///< labels prefer other places
    kWound,   ///< status line and target cross must not cover it
    kLeader,  ///< leads to a label
  };
  Kind kind = Kind::kNamed;
  render::Label label = 0;  ///< the hologram that it belongs to; 0: none
  OutlineInEyes seen;
};

/// The entry being guided to, with its surroundings.
inline constexpr float kWoundRadius_m = 0.012f;
/// The wound is open so far about all entries and strokes that are shown.
inline constexpr float kOpenRadius_m = 0.020f;

/// Replaces `obstacles` by the things that a scene's labels must not cover: the anchors of all
/// labels, target cross, rods, planned trajectory and triangle, patches. Texts are not included.
void find_obstacles(const render::Scene& scene, std::span<const GlarePatch> patches,
                    const Eyes& eyes, std::vector<LabelObstacle>& obstacles);

/// Adds the wound as far as entries and strokes show it, a rectangle around all of them: what the
/// status line must not cover, though labels lie in it.
void add_wound(const render::Scene& scene, const Eyes& eyes, std::vector<LabelObstacle>& obstacles);

}  // namespace orthonav::engine
