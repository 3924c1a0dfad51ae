#include "render/vulkan/vulkan_renderer.h"

#include <algorithm>
#include <array>
#include <exception>
#include <string>
#include <utility>

#include "base/stopwatch.h"
#include "render/frame/scene_check.h"
#include "render/vulkan/failure.h"
#include "render/vulkan/readback.h"

namespace orthonav::render {
namespace {

/// The host's device, or the one to draw with, if it can hold the images.
Result<VkPhysicalDevice> fitting_device(const Instance& instance, const RendererOptions& options,
                                        VulkanHost* host) {
  const auto physical =
      host != nullptr ? device_of(*host, instance) : choose_device(instance, options.device);
  if (!physical) {
    return physical;
  }
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(*physical, &properties);
  const Status fits = check_size(properties.limits, options.width_px, options.height_px);
  if (!fits) {
    return fits.error();
  }
  return physical;
}

/// Rank of the formats that can hold what the shaders write; higher is better. sRGB gives the same
/// bits as images that are read back. Half floats hold linear light without visible steps; 8 bits
/// of linear light show steps in dark areas, but are better than nothing.
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

/// Whether such images can be drawn into, whatever their formats.
Status check_shape(const EyeImages& images, std::uint32_t most_px) {
  const std::string size =
      std::to_string(images.width_px) + "x" + std::to_string(images.height_px) + " px";
  const auto fits = [most_px](int width_px, int height_px) {
    return width_px >= 1 && height_px >= 1 &&
           static_cast<std::uint32_t>(std::max(width_px, height_px)) <= most_px;
  };
  if (!fits(images.width_px, images.height_px)) {
    return Error{"renderer: host's images of " + size + ", limit " + std::to_string(most_px) +
                 " px"};
  }
  const PanelImages& panel = images.panel;
  if (!panel.chain.empty() && !fits(panel.width_px, panel.height_px)) {
    return Error{"renderer: host's panel of " + std::to_string(panel.width_px) + "x" +
                 std::to_string(panel.height_px) + " px, limit " + std::to_string(most_px) + " px"};
  }
  const std::size_t chains = images.layers == 2 ? 1 : 2;
  if (images.layers < 1 || images.layers > 2 || images.chains.size() != chains) {
    return Error{"renderer: host's images have " + std::to_string(images.layers) + " layers in " +
                 std::to_string(images.chains.size()) + " chains; needs 2 in 1 or 1 in 2"};
  }
  if (!images.depth_chains.empty() && images.depth_chains.size() != chains) {
    return Error{"renderer: " + std::to_string(images.depth_chains.size()) +
                 " chains of depth images beside " + std::to_string(chains)};
  }
  for (const auto* all : {&images.chains, &images.depth_chains}) {
    for (const auto& chain : *all) {
      if (chain.empty() || chain.size() != all->front().size()) {
        return Error{"renderer: a chain of " + std::to_string(chain.size()) +
                     " images beside one of " + std::to_string(all->front().size())};
      }
    }
  }
  return {};
}

Look look_of(const RendererOptions& options) {
  return {options.blend, drawn_edges(options),
          options.blend == Blend::kPremultiplied ? 0.0f : 1.0f};
}

}  // namespace

VulkanRenderer::VulkanRenderer(const RendererOptions& options, VulkanHost* host)
    : options_(options),
      instance_(options.validation, options.messages, host),
      physical_(value_of(fitting_device(instance_, options, host))),
      info_(describe(physical_)),
      device_(physical_, host),
      drawing_(options, device_, physical_),
      eyes_apart_(host == nullptr && options.eyes_a_pass == EyesAPass::kProbe &&
                  info_.type == "CPU") {}

VulkanRenderer::~VulkanRenderer() {
  // Members are destroyed one by one; none of them may be in use any more, however the last frame
  // ended.
  vkDeviceWaitIdle(device_.get());
}

/// Runs `work` and turns an exception into an Error.
template <class Work>
Status VulkanRenderer::attempt(const Work& work) {
  if (lost_) {
    return Error{"renderer: device lost", ErrorCode::kLost};
  }
  try {
    return work();
  } catch (const std::exception&) {
    const Error error = error_in_flight();
    lost_ = error.code == ErrorCode::kLost;
    return error;
  }
}

template <class Picture>
Status VulkanRenderer::begin(PassKind kind, const Frame& frame, DrawnViews drawn,
                             std::vector<Picture>& pictures, FrameTiming& timing) {
  const Status begun = attempt([&]() -> Status {
    if (const Status taken = drawing_.take(frame.scene); !taken) {
      return taken;
    }
    for (std::size_t i = drawn.first; i < drawn.first + drawn.count; ++i) {
      resize(pictures[i], options_.width_px, options_.height_px);
    }
    if (!pictures_) {
      EyeImages own;
      own.width_px = options_.width_px;
      own.height_px = options_.height_px;
      pictures_ = std::make_unique<Canvas>(drawing_, own, look_of(options_), 1);
    }
    pictures_->submit(kind, frame, drawn);
    timing.submit_ms += pictures_->submit_ms();
    return {};
  });
  if (!begun) {
    drawing_.end_frame();
  }
  return begun;
}

template <class Picture>
Status VulkanRenderer::end(const Frame& frame, DrawnViews drawn, std::vector<Picture>& pictures,
                           FrameTiming& timing) {
  const Status ended = attempt([&]() -> Status {
    // What is behind the holograms is filled in while the device draws.
    for (std::size_t i = drawn.first; i < drawn.first + drawn.count; ++i) {
      fill(pictures[i], frame.backgrounds.empty() ? nullptr : frame.backgrounds[i]);
    }
    pictures_->wait();
    const Stopwatch reading;
    for (std::size_t i = drawn.first; i < drawn.first + drawn.count; ++i) {
      render::take(pictures_->read(i), pictures_->regions(i), pictures[i]);
    }
    timing.read_ms += reading.elapsed_ms();
    return {};
  });
  drawing_.end_frame();
  return ended;
}

template <class Picture>
Status VulkanRenderer::draw_pictures(PassKind kind, const Frame& frame,
                                     std::vector<Picture>& pictures) {
  const Stopwatch watch;
  timing_ = {};
  const std::size_t views = frame.views.size();
  const bool apart = eyes_apart_ && kind == PassKind::kColour && views == kMaxViews;
  Status drawn = attempt([&]() -> Status {
    if (const Status checked = check_views(frame.views); !checked) {
      return checked;
    }
    const Status checked =
        check_backgrounds(frame.backgrounds, frame.views, options_.width_px, options_.height_px);
    if (!checked) {
      return checked;
    }
    pictures.resize(views);
    if (apart && !right_) {
      RendererOptions one_eye = options_;
      one_eye.eyes_a_pass = EyesAPass::kOne;
      right_ = std::make_unique<VulkanRenderer>(one_eye, nullptr);
    }
    return {};
  });
  const std::size_t parts = apart ? kMaxViews : 1;
  const auto renderer = [&](std::size_t part) -> VulkanRenderer& {
    return part == 0 ? *this : *right_;
  };
  const auto part_of_views = [&](std::size_t part) {
    return apart ? DrawnViews{part, 1} : DrawnViews{0, views};
  };
  std::size_t begun = 0;
  while (drawn && begun < parts) {
    drawn = renderer(begun).begin(kind, frame, part_of_views(begun), pictures, timing_);
    begun += drawn ? 1 : 0;
  }
  const double begun_ms = watch.elapsed_ms();
  // Whatever was begun is awaited, also after an error.
  for (std::size_t part = 0; part < begun; ++part) {
    const Status ended = renderer(part).end(frame, part_of_views(part), pictures, timing_);
    drawn = drawn ? ended : drawn;
  }
  timing_.total_ms = watch.elapsed_ms();
  timing_.record_ms = begun_ms - timing_.submit_ms;
  timing_.gpu_ms = timing_.total_ms - begun_ms - timing_.read_ms;
  // One eye must not go on alone.
  lost_ = lost_ || (!drawn && drawn.error().code == ErrorCode::kLost);
  return drawn;
}

Status VulkanRenderer::draw(const Scene& scene, const std::vector<View>& views,
                            const std::vector<const RgbaImage*>& backgrounds,
                            std::vector<RgbaImage>& images) {
  return draw_pictures(PassKind::kColour, {scene, views, backgrounds}, images);
}

Status VulkanRenderer::draw_labels(const Scene& scene, const std::vector<View>& views,
                                   std::vector<LabelImage>& images) {
  return draw_pictures(PassKind::kLabels, {scene, views, {}}, images);
}

VulkanObjects VulkanRenderer::objects() const {
  return {instance_.get(), physical_, device_.get(), device_.queue_family(), 0};
}

bool VulkanRenderer::offers(std::int64_t format, VkFormatFeatureFlags feature) const {
  VkFormatProperties properties;
  vkGetPhysicalDeviceFormatProperties(physical_, static_cast<VkFormat>(format), &properties);
  return (properties.optimalTilingFeatures & feature) != 0;
}

int VulkanRenderer::format_score(std::int64_t format) const {
  const int rank = rank_of(static_cast<VkFormat>(format));
  return rank > 0 && offers(format, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) ? rank : 0;
}

int VulkanRenderer::depth_format_score(std::int64_t format) const {
  const int rank = depth_rank_of(static_cast<VkFormat>(format));
  return rank > 0 && offers(format, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) ? rank : 0;
}

Status VulkanRenderer::check_images(const EyeImages& images) const {
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

void VulkanRenderer::release() {
  for (auto* canvas : {&eyes_, &panel_}) {
    if (*canvas) {
      (*canvas)->wait_for_all();
      canvas->reset();
    }
  }
}

Status VulkanRenderer::use(const EyeImages& images) {
  return attempt([&]() -> Status {
    if (const Status checked = check_images(images); !checked) {
      return checked;
    }
    release();
    constexpr std::size_t kFramesInFlight = 2;
    auto eyes = std::make_unique<Canvas>(drawing_, images, look_of(options_), kFramesInFlight);
    if (!images.panel.chain.empty()) {
      EyeImages panel;
      panel.format = images.format;
      panel.width_px = images.panel.width_px;
      panel.height_px = images.panel.height_px;
      panel.chains = {images.panel.chain};
      // Additive blending does not write alpha, which stays 0 as it was cleared. Texts need no more
      // than hard edges.
      const Blend blend =
          options_.blend == Blend::kAdditive ? Blend::kAdditive : Blend::kPremultiplied;
      panel_ = std::make_unique<Canvas>(drawing_, panel, Look{blend, Edges::kHard, 0}, 1);
    }
    eyes_ = std::move(eyes);
    return {};
  });
}

Status VulkanRenderer::prepare(const Scene& scene) {
  timing_ = {};
  return attempt([&] {
    const Stopwatch watch;
    if (eyes_) {
      eyes_->wait();
    }
    timing_.gpu_ms = watch.elapsed_ms();
    return drawing_.take(scene);
  });
}

Status VulkanRenderer::draw(const Scene& scene, const std::vector<View>& views,
                            std::span<const std::uint32_t> indices, HeadTexts head_texts) {
  Status drawn = attempt([&]() -> Status {
    const Stopwatch watch;
    if (const Status checked = check_views(views); !checked) {
      return checked;
    }
    if (!eyes_ || views.size() != kMaxViews || !eyes_->holds(indices)) {
      return Error{"renderer: swapchain image index out of range"};
    }
    eyes_->submit(PassKind::kColour, {scene, views, {}, head_texts}, {0, kMaxViews}, indices);
    timing_.submit_ms = eyes_->submit_ms();
    timing_.total_ms = watch.elapsed_ms();
    timing_.record_ms = timing_.total_ms - timing_.submit_ms;
    return {};
  });
  drawing_.end_frame();
  return drawn;
}

Status VulkanRenderer::draw_panel(const Scene& scene, const View& view, std::uint32_t index) {
  return attempt([&]() -> Status {
    panel_view_.assign(1, view);
    if (const Status checked = check_views(panel_view_); !checked) {
      return checked;
    }
    if (!panel_ || !panel_->holds({&index, 1})) {
      return Error{"renderer: no such image of the host's panel"};
    }
    if (!scene.meshes.empty() || !scene.lines.empty() || !scene.triangles.empty()) {
      return Error{"renderer: a panel may hold text only"};
    }
    panel_->wait();
    if (const Status taken = drawing_.take(scene); !taken) {
      return taken;
    }
    panel_->submit(PassKind::kColour, {scene, panel_view_, {}}, {0, 1}, {&index, 1});
    return {};
  });
}

Status VulkanRenderer::finish() {
  return attempt([&]() -> Status {
    release();
    return {};
  });
}

namespace {

Result<std::unique_ptr<Renderer>> made(RendererOptions options, VulkanHost* host) {
  if (const Status checked = check_options(options); !checked) {
    return checked.error();
  }
  // Both eyes' devices report to one.
  if (!options.messages) {
    options.messages = std::make_shared<std::vector<std::string>>();
  }
  try {
    std::unique_ptr<Renderer> renderer = std::make_unique<VulkanRenderer>(options, host);
    return renderer;
  } catch (const std::exception&) {
    return error_in_flight();
  }
}

}  // namespace

Result<std::unique_ptr<Renderer>> Renderer::create(const RendererOptions& options) {
  return made(options, nullptr);
}

Result<std::unique_ptr<Renderer>> Renderer::create(const RendererOptions& options,
                                                   VulkanHost& host) {
  return made(options, &host);
}

std::vector<DeviceInfo> list_devices() {
  std::vector<DeviceInfo> devices;
  try {
    const Instance instance(false);
    for (const VkPhysicalDevice physical : instance.devices()) {
      devices.push_back(describe(physical));
    }
  } catch (const std::exception&) {
    devices.clear();  // no Vulkan, no devices
  }
  return devices;
}

}  // namespace orthonav::render
