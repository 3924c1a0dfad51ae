#include "render/vulkan/frame_recorder.h"

#include "render/vulkan/region_recording.h"

namespace orthonav::render {
namespace {

/// What surrounds the regions, or nothing where pixels between them would cost more than a pass for
/// each of them.
PixelRect compact(const std::vector<PixelRect>& regions) {
  PixelRect all;
  long needed = 0;
  for (const PixelRect& region : regions) {
    all = joined(all, region);
    needed += region.area();
  }
  return all.area() <= needed + needed / 4 ? all : PixelRect{};
}

}  // namespace

void record_frame(VkCommandBuffer commands, const FrameSources& sources) {
  const Targets& targets = sources.pass.targets;
  const TargetSpec& spec = targets.spec();
  if (!spec.outer.empty()) {
    const PixelRect whole{0, 0, static_cast<int>(spec.width), static_cast<int>(spec.height)};
    RegionRecording(commands, sources, whole).everything();
    if (targets.copies_result()) {
      targets.copy_result(commands, sources.outer);
    }
    return;
  }
  const std::vector<PixelRect>& regions = sources.items.regions();
  if (const PixelRect all = compact(regions); !all.empty()) {
    RegionRecording(commands, sources, all).everything();
  } else {
    for (const PixelRect& region : regions) {
      RegionRecording(commands, sources, region).everything();
    }
  }
  for (const PixelRect& region : regions) {
    RegionRecording(commands, sources, region).copy();
  }
  wait_for_copies(commands, sources.readback, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
}

}  // namespace orthonav::render
