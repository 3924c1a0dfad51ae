#include "render/vulkan/frame_recorder.h"

#include "render/vulkan/region_recording.h"

namespace orthonav::render {

void record_frame(VkCommandBuffer commands, const FrameSources& sources) {
  for (const PixelRect& region : sources.items.regions()) {
    const RegionRecording part(commands, sources, region);
    part.everything();
    part.copy();
  }
  wait_for_copies(commands, sources.readback, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
}

void record_outer_frame(VkCommandBuffer commands, const FrameSources& sources) {
  const TargetSpec& spec = sources.pass.targets.spec();
  const PixelRect whole{0, 0, static_cast<int>(spec.width), static_cast<int>(spec.height)};
  RegionRecording(commands, sources, whole).everything();
  if (sources.pass.targets.copies_result()) {
    sources.pass.targets.copy_result(commands, sources.outer);
  }
}

}  // namespace orthonav::render
