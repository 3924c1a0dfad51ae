#include "render/vulkan/vulkan_renderer.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <new>
#include <stdexcept>

#include "render/projection.h"
#include "render/scene_check.h"
#include "render/vulkan/eyes_probe.h"
#include "render/vulkan/gpu_types.h"

namespace orthonav::render {
namespace {

constexpr std::uint32_t kMostViews = 2;

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

/// Twice what is needed, so that a growing scene settles soon.
VkDeviceSize grown(std::size_t bytes) { return std::max<std::size_t>(2 * bytes, 4096); }

RendererOptions checked(const RendererOptions& options) {
  if (const auto problem = problem_of_options(options)) throw std::runtime_error(*problem);
  return options;
}

/// The device, where it can hold the images.
VkPhysicalDevice fitting(VkPhysicalDevice physical, const RendererOptions& options) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical, &properties);
  const auto problem = problem_of_size(properties.limits, options.width_px, options.height_px);
  if (problem) throw std::runtime_error(*problem);
  return physical;
}

void write_line_indices(const Buffer& buffer) {
  auto* out = reinterpret_cast<std::uint32_t*>(buffer.mapped());
  const auto segments = static_cast<std::uint32_t>(buffer.size() / (4 * kIndicesPerSegment));
  for (std::uint32_t segment = 0; segment < segments; ++segment) {
    const std::uint32_t first = segment * kCornersPerSegment;
    for (std::uint32_t corner = 1; corner + 1 < kCornersPerSegment; ++corner) {
      *out++ = first;
      *out++ = first + corner;
      *out++ = first + corner + 1;
    }
  }
}

}  // namespace

VulkanRenderer::VulkanRenderer(const RendererOptions& options)
    : options_(checked(options)),
      instance_(options.validation, options.messages),
      physical_(fitting(choose_device(instance_, options.device), options)),
      info_(describe(physical_)),
      device_(physical_),
      commands_(device_),
      bindings_(device_) {
  const std::size_t both = kMostViews * image_bytes();
  background_staging_ =
      Buffer(device_, both, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::kUpload);
  readback_ = Buffer(device_, both, VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferPlace::kReadback);
  frame_ =
      Buffer(device_, sizeof(GpuFrame), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, BufferPlace::kUpload);
  upload_atlas();
  upload_blank_background();
  views_a_pass_ = views_a_pass();  // binds buffers of its own
  bindings_.bind_frame(frame_);
  prepare_data();
}

std::size_t VulkanRenderer::views_a_pass() {
  if (options_.eyes_a_pass != EyesAPass::kProbe) {
    return options_.eyes_a_pass == EyesAPass::kTwo ? 2 : 1;
  }
  return draws_both_eyes_whole(device_, commands_, bindings_, font_) ? 2 : 1;
}

VulkanRenderer::~VulkanRenderer() {
  // Members go one by one; none of them may be in use any more, whatever the last frame came to.
  vkDeviceWaitIdle(device_.get());
}

std::size_t VulkanRenderer::image_bytes() const {
  return 4 * static_cast<std::size_t>(options_.width_px) * options_.height_px;
}

void VulkanRenderer::upload_atlas() {
  const FontFileHeader& header = font_.header();
  ImageSpec spec;
  spec.format = VK_FORMAT_R8_UNORM;
  spec.width = header.width_px;
  spec.height = header.height_px;
  spec.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  spec.view = VK_IMAGE_VIEW_TYPE_2D;
  atlas_ = DeviceImage(device_, spec);
  const Buffer staging(device_, font_.atlas().size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                       BufferPlace::kUpload);
  staging.write(font_.atlas().data(), font_.atlas().size());
  fill_image(commands_.begin(), staging, atlas_, {spec.width, spec.height}, 1, 1);
  commands_.run();
  bindings_.bind_atlas(atlas_);
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
  fill_image(commands_.begin(), background_staging_, background_, {spec.width, spec.height},
             kMostViews, kMostViews);
  commands_.run();
  bindings_.bind_background(background_);
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
    pass = std::make_unique<FramePass>(device_, bindings_.layout(), spec, options_.blend);
  }
  return *pass;
}

std::string VulkanRenderer::problem_of(const Scene& scene, const std::vector<View>& views,
                                       const std::vector<const Image*>& backgrounds) {
  if (lost_) return "renderer: device lost";
  if (const auto problem = problem_of_views(views)) return *problem;
  if (const auto problem = problem_of_scene(scene)) return *problem;
  const auto problem =
      problem_of_backgrounds(backgrounds, views, options_.width_px, options_.height_px);
  if (problem) return *problem;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const MeshItem& item = scene.meshes[i];
    if (meshes_.touch(item.mesh)) continue;
    const std::string flaw = meshes_.add(device_, commands_, item.mesh);
    if (flaw.empty()) continue;
    return "scene: mesh " + std::to_string(i) + " (label " + std::to_string(item.label) +
           "): " + flaw;
  }
  return {};
}

void VulkanRenderer::write_frame(const View* views, std::size_t count, bool has_background) {
  const auto width = static_cast<float>(options_.width_px);
  const auto height = static_cast<float>(options_.height_px);
  GpuFrame frame;
  for (std::size_t i = 0; i < count; ++i) {
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
  frame_.write(&frame, sizeof(frame));
}

void VulkanRenderer::prepare_data() {
  const std::size_t bytes = items_.data().size() * sizeof(Float4);
  if (data_.size() < bytes || data_.size() == 0) {
    data_ = Buffer(device_, grown(bytes), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, BufferPlace::kUpload);
    bindings_.bind_data(data_);
  }
  data_.write(items_.data().data(), bytes);
  const std::size_t index_bytes = 4ul * kIndicesPerSegment * items_.most_segments();
  if (line_indices_.size() < index_bytes || line_indices_.size() == 0) {
    line_indices_ =
        Buffer(device_, grown(index_bytes), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, BufferPlace::kUpload);
    write_line_indices(line_indices_);
  }
}

void VulkanRenderer::draw_views(PassKind kind, const std::vector<View>& views,
                                const std::vector<const Image*>& backgrounds, std::size_t first,
                                std::size_t count) {
  const FramePass& pass = pass_for(kind, count);
  write_frame(&views[first], count, !backgrounds.empty());
  const VkCommandBuffer batch = commands_.begin();
  if (!backgrounds.empty()) {
    for (std::size_t i = 0; i < count; ++i) {
      background_staging_.write(backgrounds[first + i]->rgba.data(), image_bytes(),
                                i * image_bytes());
    }
    fill_image(batch, background_staging_, background_,
               {pass.targets.spec().width, pass.targets.spec().height},
               static_cast<std::uint32_t>(count), kMostViews);
  }
  record_frame(batch, {pass, bindings_, meshes_, items_, line_indices_, readback_,
                       first * image_bytes(), !backgrounds.empty()});
  const auto submitted = std::chrono::steady_clock::now();
  commands_.run();
  timing_.gpu_ms += milliseconds_since(submitted);
}

void VulkanRenderer::draw_into(PassKind kind, const Scene& scene, const std::vector<View>& views,
                               const std::vector<const Image*>& backgrounds) {
  const auto start = std::chrono::steady_clock::now();
  const std::string problem = problem_of(scene, views, backgrounds);
  if (!problem.empty()) throw std::runtime_error(problem);
  items_.build(scene, views, font_);
  prepare_data();
  const std::size_t at_once = std::min(views.size(), views_a_pass_);
  for (std::size_t first = 0; first < views.size(); first += at_once) {
    draw_views(kind, views, backgrounds, first, at_once);
  }
  timing_.record_ms = milliseconds_since(start) - timing_.gpu_ms;
}

template <class Picture, class Element>
void VulkanRenderer::read_back(std::size_t views, std::vector<Picture>& pictures,
                               std::vector<Element> Picture::*elements) const {
  pictures.resize(views);
  for (std::size_t i = 0; i < views; ++i) {
    pictures[i].width_px = options_.width_px;
    pictures[i].height_px = options_.height_px;
    auto& values = pictures[i].*elements;
    values.resize(image_bytes() / sizeof(Element));
    std::memcpy(values.data(), readback_.mapped() + i * image_bytes(), image_bytes());
  }
}

/// The line for the exception in flight.
std::string VulkanRenderer::line_of_failure() {
  try {
    throw;
  } catch (const VulkanFailure& failure) {
    lost_ = lost_ || commands_.lost() || failure.result() == VK_ERROR_DEVICE_LOST;
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
  meshes_.end_frame();
  timing_.total_ms = milliseconds_since(start);
  return drawn;
}

bool VulkanRenderer::draw(const Scene& scene, const std::vector<View>& views,
                          const std::vector<const Image*>& backgrounds, std::vector<Image>& images,
                          std::string& error) {
  return attempt(error, [&] {
    draw_into(PassKind::kColour, scene, views, backgrounds);
    read_back(views.size(), images, &Image::rgba);
  });
}

bool VulkanRenderer::draw_labels(const Scene& scene, const std::vector<View>& views,
                                 std::vector<LabelImage>& images, std::string& error) {
  return attempt(error, [&] {
    draw_into(PassKind::kLabels, scene, views, {});
    read_back(views.size(), images, &LabelImage::labels);
  });
}

}  // namespace orthonav::render
