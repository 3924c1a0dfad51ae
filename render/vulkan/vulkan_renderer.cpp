#include "render/vulkan/vulkan_renderer.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <new>
#include <span>
#include <stdexcept>
#include <utility>

#include "render/float3.h"
#include "render/projection.h"
#include "render/scene_check.h"
#include "render/vulkan/elapsed.h"
#include "render/vulkan/eyes_probe.h"
#include "render/vulkan/gpu_types.h"
#include "render/vulkan/readback.h"

namespace orthonav::render {
namespace {

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

}  // namespace

VulkanRenderer::VulkanRenderer(const RendererOptions& options)
    : options_(checked(options)),
      instance_(options.validation, options.messages),
      physical_(fitting(choose_device(instance_, options.device), options)),
      info_(describe(physical_)),
      device_(physical_),
      cache_(device_, physical_, options.cache_folder.value_or(user_cache_folder())),
      commands_(device_),
      bindings_(device_) {
  const std::size_t both = kMostViews * image_bytes();
  background_staging_ =
      Buffer(device_, both, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::kUpload);
  readback_ = Buffer(device_, both, VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferPlace::kReadback);
  frames_ = Buffer(device_, kMostViews * kFrameStride, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                   BufferPlace::kUpload);
  upload_atlas();
  upload_blank_background();
  views_a_pass_ = views_a_pass();  // binds buffers of its own
  bindings_.bind_frames(frames_);
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
  const PixelRect all{0, 0, static_cast<int>(spec.width), static_cast<int>(spec.height)};
  fill_image(commands_.begin(), {staging, atlas_, {spec.width, spec.height}, 1, 1, 1}, {&all, 1});
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
  const PixelRect all{0, 0, options_.width_px, options_.height_px};
  fill_image(
      commands_.begin(),
      {background_staging_, background_, {spec.width, spec.height}, 4, kMostViews, kMostViews},
      {&all, 1});
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
    pass = std::make_unique<FramePass>(device_, cache_.get(), bindings_.layout(), spec,
                                       options_.blend);
  }
  return *pass;
}

std::string VulkanRenderer::add_mesh(const MeshItem& item, const std::string& name) {
  const Matrix4& place = item.world_from_model;
  MeshDetail detail;
  detail.error = options_.surface_error_m / length({place[0], place[1], place[2]});
  std::string flaw = meshes_.add(device_, commands_, item.mesh, detail);
  if (!flaw.empty()) return flaw;
  const std::size_t drawn = meshes_.find(item.mesh)->index_count / 3;
  const std::size_t given = item.mesh->indices.size() / 3;
  if (given > detail.most_triangles) {
    note(name + ": drawn with " + std::to_string(drawn) + " of its " + std::to_string(given) +
         " triangles, limit " + std::to_string(detail.most_triangles));
  }
  return {};
}

/// After so many there is nothing new to learn, and a frame loop would fill the memory.
void VulkanRenderer::note(std::string line) {
  constexpr std::size_t kMostNotes = 200;
  if (notes_.size() < kMostNotes) notes_.push_back(std::move(line));
}

/// Of each character that the font lacks, once: a box stands in its place.
void VulkanRenderer::note_missing_glyphs(const Scene& scene) {
  for (const TextItem& item : scene.texts) {
    std::size_t noted = missing_glyphs_.size();
    find_missing(font_, item, missing_glyphs_);
    for (; noted < missing_glyphs_.size(); ++noted) {
      char code[16];
      std::snprintf(code, sizeof(code), "U+%04X", static_cast<unsigned>(missing_glyphs_[noted]));
      note("scene: text " + std::to_string(&item - scene.texts.data()) + " (label " +
           std::to_string(item.label) + "): the font has no " + code + ", drawn as a box");
    }
  }
}

std::string VulkanRenderer::problem_of(const Scene& scene, const std::vector<View>& views,
                                       const std::vector<const Image*>& backgrounds) {
  if (lost_) return "renderer: device lost";
  if (const auto problem = problem_of_views(views)) return *problem;
  if (const auto problem = problem_of_scene(scene)) return *problem;
  const auto problem =
      problem_of_backgrounds(backgrounds, views, options_.width_px, options_.height_px);
  if (problem) return *problem;
  for (const MeshItem& item : scene.meshes) {
    if (meshes_.touch(item.mesh)) continue;
    const std::string name = "scene: mesh " + std::to_string(&item - scene.meshes.data()) +
                             " (label " + std::to_string(item.label) + ")";
    const std::string flaw = add_mesh(item, name);
    if (!flaw.empty()) return name + ": " + flaw;
  }
  return {};
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
    read_back(views.size(), images, [&](std::size_t i, const std::byte* drawn, Image& image) {
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
