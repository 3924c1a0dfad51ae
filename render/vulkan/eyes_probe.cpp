#include "render/vulkan/eyes_probe.h"

#include <algorithm>
#include <span>

#include "render/projection.h"
#include "render/vulkan/frame_recorder.h"
#include "render/vulkan/gpu_types.h"

namespace orthonav::render {
namespace {

constexpr std::uint32_t kSide_px = 128;  // covers several tiles of any rasterizer
constexpr std::uint32_t kViews = 2;
constexpr Label kLabel = 1;

TargetSpec small_target(bool samples) {
  TargetSpec spec;
  spec.kind = samples ? PassKind::kColour : PassKind::kLabels;
  spec.edges = samples ? Edges::kSamples : Edges::kHard;
  spec.width = spec.height = kSide_px;
  spec.views = kViews;
  return spec;
}

/// A triangle that covers both views completely.
FrameItems covering_items(const Font& font) {
  Scene scene;
  scene.triangles.push_back({kLabel, {Float3{-9, -9, -1}, {9, -9, -1}, {0, 9, -1}}, {}});
  FrameItems items;
  const std::vector<View> views(kViews);
  const auto no_box = [](const MeshItem&) { return Box{}; };
  items.build(scene, views, font, no_box);
  items.place(views, {kSide_px, kSide_px}, no_box);
  return items;
}

/// Whether the triangle fills every pixel of both views: with its label, or with its white if
/// samples are resolved.
bool fills_both_views(const Device& device, Commands& commands, const Bindings& bindings,
                      const FrameItems& items, bool samples) {
  const FramePass pass(device, VK_NULL_HANDLE, bindings.layout(), small_target(samples),
                       Blend::kAdditive);
  GpuFrame content;
  for (GpuEye& eye : content.eyes) {
    eye.clip_from_world = clip_from_world(View{});
  }
  content.target = {kSide_px, kSide_px, 0, 0};
  const Buffer frame(device, sizeof(content), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                     BufferPlace::kUpload);
  frame.write(&content, sizeof(content));
  const std::size_t data_bytes = items.data().size() * sizeof(Float4);
  const Buffer data(device, data_bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, BufferPlace::kUpload);
  data.write(items.data().data(), data_bytes);
  constexpr std::size_t kPixels = std::size_t{kViews} * kSide_px * kSide_px;
  const Buffer readback(device, kPixels * sizeof(std::uint32_t), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                        BufferPlace::kReadback);
  bindings.bind_frames(frame);
  bindings.bind_data(data);
  const MeshCache no_meshes;
  const Buffer no_lines;
  record_frame(commands.begin(), {pass, bindings, no_meshes, items, no_lines, readback});
  commands.run();
  const std::span drawn(reinterpret_cast<const std::uint32_t*>(readback.mapped()), kPixels);
  const std::uint32_t expected = samples ? 0xffffffff : kLabel;
  return std::all_of(drawn.begin(), drawn.end(),
                     [expected](std::uint32_t pixel) { return pixel == expected; });
}

}  // namespace

bool draws_both_eyes_whole(const Device& device, Commands& commands, const Bindings& bindings,
                           const Font& font, bool samples) {
  const FrameItems items = covering_items(font);
  return fills_both_views(device, commands, bindings, items, false) &&
         (!samples || fills_both_views(device, commands, bindings, items, true));
}

}  // namespace orthonav::render
