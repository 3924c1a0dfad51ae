#include "render/vulkan/hosted_vulkan_renderer.h"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <utility>

#include "render/scene_check.h"
#include "render/vulkan/elapsed.h"
#include "render/vulkan/gpu_types.h"

namespace orthonav::render {
namespace {

/// Formats that hold what the shaders write, the better the higher. sRGB is what the images of
/// Renderer have: the same bits. Half floats hold linear light without steps; 8 bits of linear
/// light show steps in the dark, and are better than nothing.
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

/// 16 bits of a depth that reaches infinity tell too little at arm's length.
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

/// Every image that a pass may end in, chain after chain.
std::vector<VkImage> outer_images(const std::vector<std::vector<std::uint64_t>>& chains) {
  std::vector<VkImage> outer;
  for (const auto& chain : chains) {
    for (const std::uint64_t image : chain) {
      outer.push_back(reinterpret_cast<VkImage>(image));
    }
  }
  return outer;
}

/// What can't be drawn into, as one line; empty when all is well.
std::string problem_of(const EyeTargets& targets, std::uint32_t most_px, bool takes_layers) {
  const std::string size =
      std::to_string(targets.width_px) + "x" + std::to_string(targets.height_px) + " px";
  if (targets.width_px < 1 || targets.height_px < 1 ||
      static_cast<std::uint32_t>(std::max(targets.width_px, targets.height_px)) > most_px) {
    return "renderer: host's images of " + size + ", limit " + std::to_string(most_px) + " px";
  }
  const std::size_t chains = targets.layers == 2 ? 1 : 2;
  if (targets.layers < 1 || targets.layers > 2 || targets.chains.size() != chains) {
    return "renderer: host's images have " + std::to_string(targets.layers) + " layers in " +
           std::to_string(targets.chains.size()) + " chains; needs 2 in 1 or 1 in 2";
  }
  if (targets.layers == 2 && !takes_layers) {
    return "renderer: host's images have 2 layers, which this device does not draw whole";
  }
  if (!targets.depth_chains.empty() && targets.depth_chains.size() != chains) {
    return "renderer: " + std::to_string(targets.depth_chains.size()) +
           " chains of depth images beside " + std::to_string(chains);
  }
  for (const auto* all : {&targets.chains, &targets.depth_chains}) {
    for (const auto& chain : *all) {
      if (chain.empty() || chain.size() != all->front().size()) {
        return "renderer: a chain of " + std::to_string(chain.size()) + " images beside one of " +
               std::to_string(all->front().size());
      }
    }
  }
  return {};
}

/// Whether there is an image of that number in each chain, those of depth after the others.
bool holds(const EyeTargets& targets, std::span<const std::uint32_t> images) {
  const std::size_t chains = targets.chains.size();
  if (images.size() != chains + targets.depth_chains.size()) {
    return false;
  }
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto& chain = i < chains ? targets.chains[i] : targets.depth_chains[i - chains];
    if (images[i] >= chain.size()) {
      return false;
    }
  }
  return true;
}

}  // namespace

HostedVulkanRenderer::HostedVulkanRenderer(const RendererOptions& options, VulkanHost& host)
    : options_(options),
      instance_(options.validation, options.messages, &host),
      physical_(device_of(host, instance_)),
      info_(describe(physical_)),
      device_(physical_, &host),
      drawing_(options, device_, physical_, kFramesInFlight) {
  upload_blank_background();
  drawing_.choose_views_a_pass();
}

HostedVulkanRenderer::~HostedVulkanRenderer() {
  // Members go one by one; none of them may be in use any more, whatever the last frame came to.
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
  spec.layers = kMostViews;
  spec.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  background_ = DeviceImage(device_, spec);
  const Buffer black(device_, 4 * kMostViews, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                     BufferPlace::kUpload);
  const std::array<std::byte, 4 * kMostViews> zeros = {};
  black.write(zeros.data(), zeros.size());
  const PixelRect all{0, 0, 1, 1};
  Commands& commands = drawing_.slot().commands;
  fill_image(commands.begin(), {black, background_, {1, 1}, 4, kMostViews, kMostViews}, {&all, 1});
  commands.run();
  drawing_.bind_background(background_);
}

/// Nothing thrown leaves it.
template <class Work>
bool HostedVulkanRenderer::attempt(std::string& error, const Work& work) {
  if (lost_) {
    return error = "renderer: device lost", false;
  }
  try {
    work();
    return true;
  } catch (const VulkanFailure& failure) {
    lost_ = drawing_.lost() || failure.result() == VK_ERROR_DEVICE_LOST;
    error = failure.what();
  } catch (const std::bad_alloc&) {
    error = "renderer: out of host memory";
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  return false;
}

bool HostedVulkanRenderer::use(const EyeTargets& targets, std::string& error) {
  return attempt(error, [&] {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical_, &properties);
    const std::string problem =
        problem_of(targets, properties.limits.maxImageDimension2D, takes_layers());
    if (!problem.empty()) {
      throw std::runtime_error(problem);
    }
    if (!targets.depth_chains.empty() && depth_format_score(targets.depth_format) == 0) {
      throw std::runtime_error("renderer: can't draw depth into VkFormat " +
                               std::to_string(targets.depth_format));
    }
    if (format_score(targets.format) == 0) {
      throw std::runtime_error("renderer: can't draw into VkFormat " +
                               std::to_string(targets.format));
    }
    drawing_.wait_for_all();
    pass_.reset();
    depth_pass_.reset();
    TargetSpec spec;
    spec.width = static_cast<std::uint32_t>(targets.width_px);
    spec.height = static_cast<std::uint32_t>(targets.height_px);
    spec.samples = options_.samples == 4 ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;
    spec.colour = static_cast<VkFormat>(targets.format);
    spec.views = targets.layers;
    spec.outer = outer_images(targets.chains);
    pass_ = std::make_unique<FramePass>(device_, drawing_.cache(), drawing_.layout(), spec,
                                        options_.blend);
    if (!targets.depth_chains.empty()) {
      spec.kind = PassKind::kDepth;
      spec.depth = static_cast<VkFormat>(targets.depth_format);
      spec.outer = outer_images(targets.depth_chains);
      depth_pass_ = std::make_unique<FramePass>(device_, drawing_.cache(), drawing_.layout(), spec,
                                                options_.blend);
    }
    targets_ = targets;
  });
}

bool HostedVulkanRenderer::prepare(const Scene& scene, std::string& error) {
  timing_ = {};
  return attempt(error, [&] {
    const auto start = std::chrono::steady_clock::now();
    drawing_.next_slot();
    timing_.gpu_ms = milliseconds_since(start);
    if (const std::string problem = drawing_.take(scene); !problem.empty()) {
      throw std::runtime_error(problem);
    }
  });
}

void HostedVulkanRenderer::record(const std::vector<View>& views,
                                  std::span<const std::uint32_t> images) {
  const FrameSlot& slot = drawing_.slot();
  const VkCommandBuffer batch = drawing_.slot().commands.begin();
  const std::size_t at_once = pass_->targets.spec().views;
  const PixelSize size{targets_.width_px, targets_.height_px};
  const Buffer nobody_reads;
  for (std::size_t first = 0; first < views.size(); first += at_once) {
    drawing_.place(std::span(views).subspan(first, at_once), first, size, false);
    const auto frame = static_cast<std::uint32_t>(first * kFrameStride);
    const auto draw = [&](const FramePass& pass, std::size_t outer) {
      record_outer_frame(batch, {pass, slot.bindings, drawing_.meshes(), drawing_.items(),
                                 slot.line_indices, nobody_reads, 0, frame, false, outer});
    };
    draw(*pass_, first * targets_.chains.front().size() + images[first]);
    if (depth_pass_) {
      draw(*depth_pass_,
           first * targets_.depth_chains.front().size() + images[targets_.chains.size() + first]);
    }
  }
}

bool HostedVulkanRenderer::draw(const Scene& scene, const std::vector<View>& views,
                                std::span<const std::uint32_t> images, std::string& error) {
  const bool drawn = attempt(error, [&] {
    const auto start = std::chrono::steady_clock::now();
    if (const auto problem = problem_of_views(views)) {
      throw std::runtime_error(*problem);
    }
    if (!pass_ || views.size() != kMostViews || !holds(targets_, images)) {
      throw std::runtime_error("renderer: no such images of the host's");
    }
    drawing_.build(scene, views, {targets_.width_px, targets_.height_px});
    record(views, images);
    timing_.record_ms = milliseconds_since(start);
    drawing_.slot().commands.submit();
    timing_.submit_ms = drawing_.slot().commands.submit_ms();
    timing_.total_ms = milliseconds_since(start);
  });
  drawing_.end_frame();
  return drawn;
}

bool HostedVulkanRenderer::finish(std::string& error) {
  return attempt(error, [&] {
    drawing_.wait_for_all();
    pass_.reset();
    depth_pass_.reset();
  });
}

}  // namespace orthonav::render
