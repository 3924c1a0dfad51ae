#include "render/vulkan/vulkan_renderer.h"

#include <chrono>
#include <cstring>
#include <new>
#include <span>
#include <stdexcept>
#include <utility>

#include "render/scene_check.h"
#include "render/vulkan/elapsed.h"
#include "render/vulkan/readback.h"

namespace orthonav::render {
namespace {

RendererOptions checked(const RendererOptions& options) {
  if (const auto problem = problem_of_options(options)) {
    throw std::runtime_error(*problem);
  }
  return options;
}

/// The device, where it can hold the images.
VkPhysicalDevice fitting(VkPhysicalDevice physical, const RendererOptions& options) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical, &properties);
  const auto problem = problem_of_size(properties.limits, options.width_px, options.height_px);
  if (problem) {
    throw std::runtime_error(*problem);
  }
  return physical;
}

}  // namespace

VulkanRenderer::VulkanRenderer(const RendererOptions& options)
    : options_(checked(options)),
      instance_(options.validation, options.messages),
      physical_(fitting(choose_device(instance_, options.device), options)),
      info_(describe(physical_)),
      device_(physical_),
      drawing_(options, device_, physical_, 1) {
  const std::size_t both = kMostViews * image_bytes();
  background_staging_ =
      Buffer(device_, both, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::kUpload);
  readback_ = Buffer(device_, both, VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferPlace::kReadback);
  upload_blank_background();
  drawing_.choose_views_a_pass();
}

VulkanRenderer::~VulkanRenderer() {
  // Members go one by one; none of them may be in use any more, whatever the last frame came to.
  vkDeviceWaitIdle(device_.get());
}

std::size_t VulkanRenderer::image_bytes() const {
  return 4 * static_cast<std::size_t>(options_.width_px) * options_.height_px;
}

void VulkanRenderer::upload_blank_background() {
  ImageSpec spec;
  spec.format = kColourFormat;
  spec.width = static_cast<std::uint32_t>(options_.width_px);
  spec.height = static_cast<std::uint32_t>(options_.height_px);
  spec.layers = kMostViews;
  spec.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  background_ = DeviceImage(device_, spec);
  std::memset(background_staging_.mapped(), 0, background_staging_.size());
  const PixelRect all{0, 0, options_.width_px, options_.height_px};
  Commands& commands = drawing_.slot().commands;
  fill_image(
      commands.begin(),
      {background_staging_, background_, {spec.width, spec.height}, 4, kMostViews, kMostViews},
      {&all, 1});
  commands.run();
  drawing_.bind_background(background_);
}

const FramePass& VulkanRenderer::pass_for(PassKind kind, std::size_t views) {
  auto& pass = passes_[(kind == PassKind::kLabels ? 2 : 0) + views - 1];
  if (!pass) {
    TargetSpec spec;
    spec.kind = kind;
    spec.width = static_cast<std::uint32_t>(options_.width_px);
    spec.height = static_cast<std::uint32_t>(options_.height_px);
    spec.views = static_cast<std::uint32_t>(views);
    spec.samples = options_.samples == 4 ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;
    pass = std::make_unique<FramePass>(device_, drawing_.cache(), drawing_.layout(), spec,
                                       options_.blend);
  }
  return *pass;
}

std::string VulkanRenderer::problem_of(const Scene& scene, const std::vector<View>& views,
                                       const std::vector<const RgbaImage*>& backgrounds) {
  if (lost_) {
    return "renderer: device lost";
  }
  if (const auto problem = problem_of_views(views)) {
    return *problem;
  }
  const auto problem =
      problem_of_backgrounds(backgrounds, views, options_.width_px, options_.height_px);
  if (problem) {
    return *problem;
  }
  return drawing_.take(scene);
}

template <class Picture, class Take>
void VulkanRenderer::read_back(std::size_t views, std::vector<Picture>& pictures,
                               const Take& take_picture) {
  const auto start = std::chrono::steady_clock::now();
  pictures.resize(views);
  for (std::size_t i = 0; i < views; ++i) {
    pictures[i].width_px = options_.width_px;
    pictures[i].height_px = options_.height_px;
    take_picture(i, readback_.mapped() + i * image_bytes(), pictures[i]);
  }
  timing_.read_ms = milliseconds_since(start);
}

/// The line for the exception in flight.
std::string VulkanRenderer::line_of_failure() {
  try {
    throw;
  } catch (const VulkanFailure& failure) {
    lost_ = lost_ || drawing_.lost() || failure.result() == VK_ERROR_DEVICE_LOST;
    return failure.what();
  } catch (const std::runtime_error& refusal) {
    return refusal.what();
  } catch (const std::bad_alloc&) {
    return "renderer: out of host memory";
  } catch (const std::exception& failure) {
    return std::string("renderer: ") + failure.what();
  }
}

/// Nothing thrown leaves it, and a frame ends for the meshes however it ended.
template <class Work>
bool VulkanRenderer::attempt(std::string& error, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  timing_ = {};
  bool drawn = false;
  try {
    work();
    drawn = true;
  } catch (const std::exception&) {
    error = line_of_failure();
  }
  drawing_.end_frame();
  timing_.total_ms = milliseconds_since(start);
  return drawn;
}

bool VulkanRenderer::draw(const Scene& scene, const std::vector<View>& views,
                          const std::vector<const RgbaImage*>& backgrounds,
                          std::vector<RgbaImage>& images, std::string& error) {
  return attempt(error, [&] {
    draw_into(PassKind::kColour, scene, views, backgrounds);
    read_back(views.size(), images, [&](std::size_t i, const std::byte* drawn, RgbaImage& image) {
      take(drawn, drawn_[i], backgrounds.empty() ? nullptr : backgrounds[i], image);
    });
  });
}

bool VulkanRenderer::draw_labels(const Scene& scene, const std::vector<View>& views,
                                 std::vector<LabelImage>& images, std::string& error) {
  return attempt(error, [&] {
    draw_into(PassKind::kLabels, scene, views, {});
    read_back(views.size(), images, [&](std::size_t i, const std::byte* drawn, LabelImage& image) {
      take(drawn, drawn_[i], image);
    });
  });
}

}  // namespace orthonav::render
