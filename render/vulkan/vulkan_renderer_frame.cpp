#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <stdexcept>

#include "render/projection.h"
#include "render/text/text_layout.h"
#include "render/vulkan/elapsed.h"
#include "render/vulkan/gpu_types.h"
#include "render/vulkan/vulkan_renderer.h"

namespace orthonav::render {
namespace {

constexpr float kUnseen_px = 0.1f;  // less than half the distance between samples

/// Twice what is needed, so that a growing scene settles soon.
VkDeviceSize grown(std::size_t bytes) { return std::max<std::size_t>(2 * bytes, 4096); }

void write_line_indices(const Buffer& buffer) {
  auto* out = reinterpret_cast<std::uint32_t*>(buffer.mapped());
  const std::uint32_t segments = line_capacity(buffer);
  for (std::uint32_t segment = 0; segment < segments; ++segment) {
    const std::uint32_t first = segment * kCornersPerSegment;
    for (std::uint32_t corner = 1; corner + 1 < kCornersPerSegment; ++corner) {
      *out++ = first;
      *out++ = first + corner;
      *out++ = first + corner + 1;
    }
  }
  for (std::uint32_t segment = 0; segment < segments; ++segment) {
    constexpr std::array<std::uint32_t, kIndicesPerQuad> kSides = {0, 6, 7, 0, 7, 13};
    for (const std::uint32_t corner : kSides) *out++ = segment * kCornersPerSegment + corner;
  }
}

}  // namespace

/// Of the pass whose first view is `first`.
void VulkanRenderer::write_frame(std::span<const View> views, std::size_t first,
                                 bool has_background) {
  const auto width = static_cast<float>(options_.width_px);
  const auto height = static_cast<float>(options_.height_px);
  GpuFrame frame;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Float3 eye = transformed(rigid_inverse(views[i].eye_from_world), {0, 0, 0});
    const View& view = views[i];
    frame.eyes[i] = {
        clip_from_world(view),
        {eye.x, eye.y, eye.z, 1},
        {width / (view.tan_left + view.tan_right), height / (view.tan_up + view.tan_down), 0, 0}};
  }
  frame.target = {width, height, 0, 0};
  frame.font = {font_.header().reach, kRimWidth, kNearPlane_m, 0};
  frame.mode = {options_.blend == Blend::kOver ? 1u : 0u, has_background ? 1u : 0u, 0, 0};
  frames_.write(&frame, sizeof(frame), first * kFrameStride);
}

void VulkanRenderer::prepare_data() {
  const std::size_t bytes = items_.data().size() * sizeof(Float4);
  if (data_.size() < bytes || data_.size() == 0) {
    data_ = Buffer(device_, grown(bytes), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, BufferPlace::kUpload);
    bindings_.bind_data(data_);
  }
  data_.write(items_.data().data(), bytes);
  const std::size_t index_bytes =
      4ul * (kIndicesPerSegment + kIndicesPerQuad) * items_.most_segments();
  if (line_indices_.size() < index_bytes || line_indices_.size() == 0) {
    line_indices_ =
        Buffer(device_, grown(index_bytes), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, BufferPlace::kUpload);
    write_line_indices(line_indices_);
  }
}

/// The parts of them that shaders will look at, for the pass whose first view is `first`.
void VulkanRenderer::upload_backgrounds(VkCommandBuffer batch,
                                        std::span<const Image* const> backgrounds,
                                        std::size_t first) {
  for (std::size_t i = 0; i < backgrounds.size(); ++i) {
    for (const PixelRect& region : items_.regions()) {
      for (int y = region.top; y < region.bottom; ++y) {
        const std::size_t at = 4 * (static_cast<std::size_t>(y) * options_.width_px + region.left);
        background_staging_.write(&backgrounds[i]->rgba[at],
                                  4 * static_cast<std::size_t>(region.width()),
                                  (first + i) * image_bytes() + at);
      }
    }
  }
  const VkExtent2D extent = {static_cast<std::uint32_t>(options_.width_px),
                             static_cast<std::uint32_t>(options_.height_px)};
  fill_image(batch,
             {background_staging_, background_, extent, 4,
              static_cast<std::uint32_t>(backgrounds.size()), kMostViews, first * image_bytes()},
             items_.regions());
}

void VulkanRenderer::record_pass(VkCommandBuffer batch, PassKind kind, std::span<const View> views,
                                 std::span<const Image* const> backgrounds, std::size_t first) {
  items_.place(views, {options_.width_px, options_.height_px}, [this](const MeshItem& item) {
    const GpuMesh* copy = meshes_.find(item.mesh);
    return copy != nullptr ? copy->box : Box{};
  });
  for (std::size_t i = 0; i < views.size(); ++i) drawn_[first + i] = items_.regions();
  write_frame(views, first, !backgrounds.empty());
  if (!backgrounds.empty()) upload_backgrounds(batch, backgrounds, first);
  record_frame(batch, {pass_for(kind, views.size()), bindings_, meshes_, items_, line_indices_,
                       readback_, first * image_bytes(),
                       static_cast<std::uint32_t>(first * kFrameStride), !backgrounds.empty()});
}

/// What a line may be off by without a trace: kUnseen_px where pixels are smallest.
float VulkanRenderer::unseen_rad(const std::vector<View>& views) const {
  float least = std::numeric_limits<float>::max();
  for (const View& view : views) {
    const float across = (view.tan_left + view.tan_right) / static_cast<float>(options_.width_px);
    const float down = (view.tan_up + view.tan_down) / static_cast<float>(options_.height_px);
    // Aside of the axis, a pixel is seen under a smaller angle.
    const float aside = std::max({view.tan_left, view.tan_right, view.tan_up, view.tan_down});
    least = std::min(least, std::min(across, down) / (1 + 2 * aside * aside));
  }
  return kUnseen_px * least;
}

void VulkanRenderer::draw_into(PassKind kind, const Scene& scene, const std::vector<View>& views,
                               const std::vector<const Image*>& backgrounds) {
  const auto start = std::chrono::steady_clock::now();
  const std::string problem = problem_of(scene, views, backgrounds);
  if (!problem.empty()) throw std::runtime_error(problem);
  note_missing_glyphs(scene);
  items_.build(scene, views, font_, unseen_rad(views));
  prepare_data();
  const std::size_t at_once = std::min(views.size(), views_a_pass_);
  const VkCommandBuffer batch = commands_.begin();
  for (std::size_t first = 0; first < views.size(); first += at_once) {
    const std::span<const Image* const> behind(backgrounds);
    record_pass(batch, kind, std::span(views).subspan(first, at_once),
                behind.empty() ? behind : behind.subspan(first, at_once), first);
  }
  timing_.record_ms = milliseconds_since(start);
  commands_.run();
  timing_.submit_ms = commands_.submit_ms();
  timing_.gpu_ms = milliseconds_since(start) - timing_.record_ms - timing_.submit_ms;
}

}  // namespace orthonav::render
