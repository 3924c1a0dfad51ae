#include "engine/holograms/labels/glare_patches.h"

#include <algorithm>

#include "engine/holograms/anchored_frame.h"
#include "engine/holograms/shapes/render_values.h"

namespace orthonav::engine {

void write_patches(const Guidance& guidance, std::vector<GlarePatch>& patches) {
  patches.clear();
  for (const ToolSight& tool : guidance.tools) {
    for (const auto& paper : tool.papers) {
      GlarePatch& patch = patches.emplace_back();
      std::transform(paper.begin(), paper.end(), patch.begin(),
                     [](const Point<World>& corner) { return to_float3(corner.v); });
    }
  }
  if (guidance.anchor) {
    take_to_map(guidance.anchor->world_from_anchored, patches);
  }
}

}  // namespace orthonav::engine
