#include "render/vulkan/vulkan_renderer.h"

#include <cstring>
#include <exception>
#include <span>

#include "render/frame/scene_check.h"
#include "render/vulkan/failure.h"
#include "render/vulkan/readback.h"

namespace orthonav::render {
namespace {

/// The device to draw with, if it can hold the images.
Result<VkPhysicalDevice> fitting_device(const Instance& instance, const RendererOptions& options) {
  const auto physical = choose_device(instance, options.device);
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

}  // namespace

VulkanRenderer::VulkanRenderer(const RendererOptions& options)
    : options_(options),
      instance_(options.validation, options.messages),
      physical_(value_of(fitting_device(instance_, options))),
      info_(describe(physical_)),
      device_(physical_),
      drawing_(options, device_, physical_, 1) {
  const std::size_t both = kMaxViews * image_bytes();
  background_staging_ =
      Buffer(device_, both, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::kUpload);
  readback_ = Buffer(device_, both, VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferPlace::kReadback);
  upload_blank_background();
  drawing_.choose_views_a_pass();
}

VulkanRenderer::~VulkanRenderer() {
  // Members are destroyed one by one; none of them may be in use any more, however the last frame
  // ended.
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
  spec.layers = kMaxViews;
  spec.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  background_ = DeviceImage(device_, spec);
  std::memset(background_staging_.mapped(), 0, background_staging_.size());
  const PixelRect all{0, 0, options_.width_px, options_.height_px};
  Commands& commands = drawing_.slot().commands;
  fill_image(commands.begin(),
             {background_staging_, background_, {spec.width, spec.height}, 4, kMaxViews, kMaxViews},
             {&all, 1});
  commands.run();
  drawing_.bind_background(background_);
  if (drawing_.covers()) {
    drawn_so_far_ = DeviceImage(device_, spec);
  }
  drawing_.bind_drawn(drawing_.covers() ? drawn_so_far_ : background_);
}

const FramePass& VulkanRenderer::pass_for(PassKind kind, std::size_t views) {
  auto& pass = passes_[(kind == PassKind::kLabels ? 2 : 0) + views - 1];
  if (!pass) {
    TargetSpec spec;
    spec.kind = kind;
    spec.width = static_cast<std::uint32_t>(options_.width_px);
    spec.height = static_cast<std::uint32_t>(options_.height_px);
    spec.views = static_cast<std::uint32_t>(views);
    spec.edges = drawn_edges(options_);
    pass = std::make_unique<FramePass>(device_, drawing_.cache(), drawing_.layout(), spec,
                                       options_.blend);
  }
  return *pass;
}

Status VulkanRenderer::take_input(const Scene& scene, const std::vector<View>& views,
                                  const std::vector<const RgbaImage*>& backgrounds) {
  if (lost_) {
    return Error{"renderer: device lost", ErrorCode::kLost};
  }
  if (const Status checked = check_views(views); !checked) {
    return checked;
  }
  const Status checked =
      check_backgrounds(backgrounds, views, options_.width_px, options_.height_px);
  if (!checked) {
    return checked;
  }
  return drawing_.take(scene);
}

template <class Picture, class Fill>
Status VulkanRenderer::draw_into(std::vector<Picture>& pictures, PassKind kind, const Scene& scene,
                                 const std::vector<View>& views,
                                 const std::vector<const RgbaImage*>& backgrounds,
                                 const Fill& fill_picture) {
  if (const Status taken = take_input(scene, views, backgrounds); !taken) {
    return taken;
  }
  pictures.resize(views.size());
  for (Picture& picture : pictures) {
    resize(picture, options_.width_px, options_.height_px);
  }
  submit(kind, {scene, views, backgrounds}, {0, views.size()});
  // Nothing throws between submitting a frame and waiting for it.
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    fill_picture(pictures[i], i);
  }
  finish();
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    take(readback_.mapped() + i * image_bytes(), drawn_[i], pictures[i]);
  }
  timing_.read_ms = phase_.elapsed_ms();
  return {};
}

/// Turns exceptions into Errors.
template <class Work>
Status VulkanRenderer::guarded(const Work& work) {
  try {
    return work();
  } catch (const std::exception&) {
    Error error = error_in_flight();
    lost_ = lost_ || drawing_.lost() || error.code == ErrorCode::kLost;
    if (lost_) {
      error.code = ErrorCode::kLost;
    }
    return error;
  }
}

/// Ends the frame for the mesh cache however it ended.
template <class Work>
Status VulkanRenderer::attempt(const Work& work) {
  const Stopwatch watch;
  phase_ = watch;
  timing_ = {};
  const Status drawn = guarded(work);
  drawing_.end_frame();
  timing_.total_ms = watch.elapsed_ms();
  return drawn;
}

Status VulkanRenderer::draw(const Scene& scene, const std::vector<View>& views,
                            const std::vector<const RgbaImage*>& backgrounds,
                            std::vector<RgbaImage>& images) {
  return attempt([&] {
    return draw_into(images, PassKind::kColour, scene, views, backgrounds,
                     [&](RgbaImage& image, std::size_t i) {
                       fill(image, backgrounds.empty() ? nullptr : backgrounds[i]);
                     });
  });
}

Status VulkanRenderer::begin_eye(const EyeFrame& frame, std::size_t eye, RgbaImage& image) {
  phase_ = Stopwatch();
  timing_ = {};
  const Status begun = guarded([&]() -> Status {
    if (const Status taken = take_input(frame.scene, frame.views, frame.backgrounds); !taken) {
      return taken;
    }
    resize(image, options_.width_px, options_.height_px);
    submit(PassKind::kColour, frame, {eye, 1});
    return {};
  });
  if (!begun) {
    drawing_.end_frame();
  }
  return begun;
}

Status VulkanRenderer::end_eye(const EyeFrame& frame, std::size_t eye, RgbaImage& image) {
  const Status ended = guarded([&]() -> Status {
    fill(image, frame.backgrounds.empty() ? nullptr : frame.backgrounds[eye]);
    finish();
    take(readback_.mapped() + eye * image_bytes(), drawn_[eye], image);
    timing_.read_ms = phase_.elapsed_ms();
    return {};
  });
  drawing_.end_frame();
  return ended;
}

Status VulkanRenderer::draw_labels(const Scene& scene, const std::vector<View>& views,
                                   std::vector<LabelImage>& images) {
  return attempt([&] {
    return draw_into(images, PassKind::kLabels, scene, views, {},
                     [](LabelImage& image, std::size_t) { fill(image); });
  });
}

}  // namespace orthonav::render
