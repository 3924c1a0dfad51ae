#include "render/vulkan/hosted_vulkan_renderer.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/stopwatch.h"
#include "render/frame/scene_check.h"
#include "render/vulkan/eye_images.h"
#include "render/vulkan/failure.h"
#include "render/vulkan/gpu_types.h"

namespace orthonav::render {
namespace {

/// Rank of the formats that can hold what the shaders write; higher is better. sRGB gives the same
/// bits as Renderer's images. Half floats hold linear light without visible steps; 8 bits of linear
/// light show steps in dark areas, but are better than nothing.
int rank_of(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R8G8B8A8_SRGB:
      return 6;
    case VK_FORMAT_B8G8R8A8_SRGB:
      return 5;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
      return 4;
    case VK_FORMAT_R8G8B8A8_UNORM:
      return 2;
    case VK_FORMAT_B8G8R8A8_UNORM:
      return 1;
    default:
      return 0;
  }
}

/// 16 bits of a depth that reaches infinity resolve too little at arm's length.
int depth_rank_of(VkFormat format) {
  switch (format) {
    case VK_FORMAT_D32_SFLOAT:
      return 3;
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
      return 2;
    case VK_FORMAT_D24_UNORM_S8_UINT:
      return 1;
    default:
      return 0;
  }
}

}  // namespace

HostedVulkanRenderer::HostedVulkanRenderer(const RendererOptions& options, VulkanHost& host)
    : options_(options),
      instance_(options.validation, options.messages, &host),
      physical_(value_of(device_of(host, instance_))),
      info_(describe(physical_)),
      device_(physical_, &host),
      drawing_(options, device_, physical_, kFramesInFlight, true) {
  upload_blank_background();
  drawing_.choose_views_a_pass();
}

HostedVulkanRenderer::~HostedVulkanRenderer() {
  // Members are destroyed one by one; none of them may be in use any more, however the last frame
  // ended.
  vkDeviceWaitIdle(device_.get());
}

VulkanObjects HostedVulkanRenderer::objects() const {
  return {instance_.get(), physical_, device_.get(), device_.queue_family(), 0};
}

bool HostedVulkanRenderer::offers(std::int64_t format, VkFormatFeatureFlags feature) const {
  VkFormatProperties properties;
  vkGetPhysicalDeviceFormatProperties(physical_, static_cast<VkFormat>(format), &properties);
  return (properties.optimalTilingFeatures & feature) != 0;
}

int HostedVulkanRenderer::format_score(std::int64_t format) const {
  const int rank = rank_of(static_cast<VkFormat>(format));
  return rank > 0 && offers(format, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) ? rank : 0;
}

int HostedVulkanRenderer::depth_format_score(std::int64_t format) const {
  const int rank = depth_rank_of(static_cast<VkFormat>(format));
  return rank > 0 && offers(format, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) ? rank : 0;
}

void HostedVulkanRenderer::upload_blank_background() {
  ImageSpec spec;
  spec.format = kColourFormat;
  spec.width = spec.height = 1;
  spec.layers = kMaxViews;
  spec.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  background_ = DeviceImage(device_, spec);
  const Buffer black(device_, 4 * kMaxViews, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                     BufferPlace::kUpload);
  const std::array<std::byte, 4 * kMaxViews> zeros = {};
  black.write(zeros.data(), zeros.size());
  const PixelRect all{0, 0, 1, 1};
  Commands& commands = drawing_.slot().commands;
  fill_image(commands.begin(), {black, background_, {1, 1}, 4, kMaxViews, kMaxViews}, {&all, 1});
  commands.run();
  drawing_.bind_background(background_);
  drawing_.bind_drawn(background_);
}

Status HostedVulkanRenderer::check_images(const EyeImages& images) const {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical_, &properties);
  const Status shape = check_shape(images, properties.limits.maxImageDimension2D);
  if (!shape) {
    return shape;
  }
  if (!images.depth_chains.empty() && depth_format_score(images.depth_format) == 0) {
    return Error{"renderer: can't draw depth into VkFormat " + std::to_string(images.depth_format)};
  }
  if (format_score(images.format) == 0) {
    return Error{"renderer: can't draw into VkFormat " + std::to_string(images.format)};
  }
  return {};
}

void HostedVulkanRenderer::make_passes() {
  TargetSpec spec;
  spec.width = static_cast<std::uint32_t>(images_.width_px);
  spec.height = static_cast<std::uint32_t>(images_.height_px);
  spec.edges = drawn_edges(options_);
  spec.colour = static_cast<VkFormat>(images_.format);
  spec.views = std::min(images_.layers, static_cast<std::uint32_t>(drawing_.views_a_pass()));
  spec.outer = outer_images(images_.chains);
  spec.outer_layers = images_.layers;
  auto pass = std::make_unique<FramePass>(device_, drawing_.cache(), drawing_.layout(), spec,
                                          options_.blend);
  if (!images_.depth_chains.empty()) {
    spec.kind = PassKind::kDepth;
    spec.depth = static_cast<VkFormat>(images_.depth_format);
    spec.outer = outer_images(images_.depth_chains);
    depth_pass_ = std::make_unique<FramePass>(device_, drawing_.cache(), drawing_.layout(), spec,
                                              options_.blend);
  }
  if (drawing_.covers()) {
    ImageSpec copied;
    copied.format = spec.colour;
    copied.width = spec.width;
    copied.height = spec.height;
    copied.layers = kMaxViews;
    copied.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    drawn_so_far_ = DeviceImage(device_, copied);
    drawing_.bind_drawn(drawn_so_far_);
  }
  if (!images_.panel.chain.empty()) {
    make_panel_pass();
  }
  pass_ = std::move(pass);
}

Status HostedVulkanRenderer::use(const EyeImages& images) {
  return attempt([&]() -> Status {
    if (const Status checked = check_images(images); !checked) {
      return checked;
    }
    drawing_.wait_for_all();
    pass_.reset();
    depth_pass_.reset();
    panel_pass_.reset();
    images_ = images;
    make_passes();
    return {};
  });
}

Status HostedVulkanRenderer::prepare(const Scene& scene) {
  timing_ = {};
  return attempt([&] {
    const Stopwatch watch;
    drawing_.next_slot();
    timing_.gpu_ms = watch.elapsed_ms();
    return drawing_.take(scene);
  });
}

void HostedVulkanRenderer::record(const std::vector<View>& views,
                                  std::span<const std::uint32_t> indices) {
  const FrameSlot& slot = drawing_.slot();
  const VkCommandBuffer batch = drawing_.slot().commands.begin();
  const std::size_t at_once = pass_->targets.spec().views;
  const PixelSize size{images_.width_px, images_.height_px};
  const Buffer nobody_reads;
  for (std::size_t first = 0; first < views.size(); first += at_once) {
    drawing_.place(std::span(views).subspan(first, at_once), first, size);
    const auto frame = static_cast<std::uint32_t>(first * kFrameStride);
    // Image `indices[chain]` of the eye's own chain, or the eye's layer of it in a shared chain.
    const auto outer_of = [&](const auto& chains, std::size_t first_index) {
      const std::size_t chain = chains.size() == 1 ? 0 : first;
      const std::size_t image = chain * chains.front().size() + indices[first_index + chain];
      const std::size_t passes = pass_->targets.spec().passes_an_image();
      return image * passes + (passes > 1 ? first : 0);
    };
    const auto draw = [&](const FramePass& pass, std::size_t outer) {
      record_outer_frame(batch, {pass, slot.bindings, drawing_.meshes(), drawing_.items(),
                                 slot.line_indices, nobody_reads, 0, frame, false, outer,
                                 drawing_.edges(first), drawn_so_far_.get()});
    };
    draw(*pass_, outer_of(images_.chains, 0));
    if (depth_pass_) {
      draw(*depth_pass_, outer_of(images_.depth_chains, images_.chains.size()));
    }
  }
}

Status HostedVulkanRenderer::draw(const Scene& scene, const std::vector<View>& views,
                                  std::span<const std::uint32_t> indices, HeadTexts head_texts) {
  Status drawn = attempt([&]() -> Status {
    const Stopwatch watch;
    if (const Status checked = check_views(views); !checked) {
      return checked;
    }
    if (!pass_ || views.size() != kMaxViews || !holds(images_, indices)) {
      return Error{"renderer: swapchain image index out of range"};
    }
    drawing_.build(scene, views, {images_.width_px, images_.height_px}, PassKind::kColour,
                   {0, views.size()}, head_texts);
    record(views, indices);
    timing_.record_ms = watch.elapsed_ms();
    drawing_.slot().commands.submit();
    timing_.submit_ms = drawing_.slot().commands.submit_ms();
    timing_.total_ms = watch.elapsed_ms();
    return {};
  });
  drawing_.end_frame();
  return drawn;
}

Status HostedVulkanRenderer::finish() {
  return attempt([&]() -> Status {
    drawing_.wait_for_all();
    pass_.reset();
    depth_pass_.reset();
    panel_pass_.reset();
    return {};
  });
}

}  // namespace orthonav::render
