#include "render/vulkan/scene_drawing.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <utility>

#include "render/decimated.h"
#include "render/float3.h"
#include "render/frame/scene_check.h"
#include "render/projection.h"
#include "render/text/text_layout.h"
#include "render/vulkan/eyes_probe.h"
#include "render/vulkan/gpu_types.h"

namespace orthonav::render {
namespace {

constexpr float kUnseen_px = 0.1f;   // less than half the distance between samples
constexpr float kSurface_px = 0.2f;  // of a surface, mean over triangles; 0.15 amid the image

/// Twice what is needed, so that a growing scene soon stops reallocating.
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
    for (const std::uint32_t corner : kSides) {
      *out++ = segment * kCornersPerSegment + corner;
    }
  }
  for (std::uint32_t segment = 0; segment < segments; ++segment) {
    for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) {
      *out++ = 4 * segment + corner;
    }
  }
}

float scale_of(const MeshItem& item) {
  const Matrix4& place = item.world_from_model;
  return length(Float3(place[0]));
}

/// The angle that a pixel subtends where pixels are smallest.
float pixel_rad(const std::vector<View>& views, PixelSize size) {
  float least = std::numeric_limits<float>::max();
  for (const View& view : views) {
    const float across = (view.tan_left + view.tan_right) / static_cast<float>(size.width_px);
    const float down = (view.tan_up + view.tan_down) / static_cast<float>(size.height_px);
    // Away from the axis, a pixel subtends a smaller angle.
    const float aside = std::max({view.tan_left, view.tan_right, view.tan_up, view.tan_down});
    least = std::min(least, std::min(across, down) / (1 + 2 * aside * aside));
  }
  return least;
}

/// How near a mesh may be to an eye, never too far.
float nearest_m(const MeshItem& item, const Box& box, const std::vector<View>& views) {
  const Float3 middle = transformed(item.world_from_model, 0.5f * (box.low + box.high));
  float nearest = std::numeric_limits<float>::max();
  for (const View& view : views) {
    nearest = std::min(nearest, length(transformed(view.eye_from_world, middle)));
  }
  return std::max(nearest - 0.5f * scale_of(item) * length(box.high - box.low), 0.0f);
}

}  // namespace

FrameSlot::FrameSlot(const Device& device)
    : commands(device),
      bindings(device),
      frames(device, kMaxViews * kFrameStride, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
             BufferPlace::kUpload) {}

SceneDrawing::SceneDrawing(const RendererOptions& options, const Device& device,
                           VkPhysicalDevice physical)
    : options_(options),
      device_(device),
      cache_(device, physical, options.cache_folder.value_or(user_cache_folder())),
      uploads_(device),
      meshes_({covers(), options.every_triangle}) {
  upload_atlas();
  upload_blank();
  choose_views_a_pass();
}

void SceneDrawing::upload_atlas() {
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
  fill_image(uploads_.begin(), {staging, atlas_, {spec.width, spec.height}, 1, 1, 1}, {&all, 1});
  uploads_.run();
}

void SceneDrawing::upload_blank() {
  ImageSpec spec;
  spec.format = kColourFormat;
  spec.width = spec.height = 1;
  spec.layers = kMaxViews;
  spec.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  blank_ = DeviceImage(device_, spec);
  const std::array<std::byte, 4 * kMaxViews> zeros = {};
  const Buffer black(device_, zeros.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, BufferPlace::kUpload);
  black.write(zeros.data(), zeros.size());
  const PixelRect all{0, 0, 1, 1};
  fill_image(uploads_.begin(), {black, blank_, {1, 1}, 4, kMaxViews, kMaxViews}, {&all, 1});
  uploads_.run();
}

std::unique_ptr<FrameSlot> SceneDrawing::make_slot() const {
  auto slot = std::make_unique<FrameSlot>(device_);
  slot->bindings.bind_frames(slot->frames);
  slot->bindings.bind_atlas(atlas_);
  slot->bindings.bind_background(blank_);
  slot->bindings.bind_drawn(blank_);
  return slot;
}

void SceneDrawing::choose_views_a_pass() {
  if (options_.eyes_a_pass != EyesAPass::kProbe) {
    views_a_pass_ = options_.eyes_a_pass == EyesAPass::kTwo ? 2 : 1;
    return;
  }
  const auto slot = make_slot();
  const bool both = draws_both_eyes_whole(device_, slot->commands, slot->bindings, font_,
                                          drawn_edges(options_) == Edges::kSamples);
  views_a_pass_ = both ? 2 : 1;
}

Status SceneDrawing::add_mesh(const MeshItem& item, const std::string& name) {
  if (const Status added = meshes_.add(device_, uploads_, item.mesh); !added) {
    return Error{name + ": " + added.error().message, added.error().code};
  }
  const std::size_t given = item.mesh->indices.size() / 3;
  const std::size_t limit = MeshDetail{}.most_triangles;
  if (given > limit && !item.mesh->levels.empty() && !options_.every_triangle) {
    note(name + ": drawn with " + std::to_string(item.mesh->levels.front().indices.size() / 3) +
         " of its " + std::to_string(given) + " triangles, limit " + std::to_string(limit));
  }
  return {};
}

/// More notes tell nothing new, and a frame loop would fill the memory.
void SceneDrawing::note(std::string line) {
  constexpr std::size_t kMaxNotes = 200;
  if (notes_.size() < kMaxNotes) {
    notes_.push_back(std::move(line));
  }
}

/// Notes each character that the font lacks, once: a box is drawn instead.
void SceneDrawing::note_missing_glyphs(const Scene& scene) {
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

Status SceneDrawing::take(const Scene& scene) {
  if (const Status checked = check_scene(scene); !checked) {
    return checked;
  }
  for (const MeshItem& item : scene.meshes) {
    if (meshes_.touch(item.mesh)) {
      continue;
    }
    const std::string name = "scene: mesh " + std::to_string(&item - scene.meshes.data()) +
                             " (label " + std::to_string(item.label) + ")";
    if (const Status added = add_mesh(item, name); !added) {
      return added;
    }
  }
  note_missing_glyphs(scene);
  return {};
}

void SceneDrawing::build(const Frame& frame, PixelSize size, PassKind kind, DrawnViews drawn,
                         FrameSlot& slot) {
  const float rad = pixel_rad(frame.views, size);
  items_.build(
      frame.scene, frame.views, font_,
      [this](const MeshItem& item) { return meshes_.find(item.mesh)->box; }, kUnseen_px * rad,
      frame.head_texts);
  items_.set_levels([&](const MeshItem& item) {
    const GpuMesh& copy = *meshes_.find(item.mesh);
    const float error_m = kSurface_px * rad * nearest_m(item, copy.box, frame.views);
    return copy.level_within(error_m / scale_of(item));
  });
  edges_.clear();
  edges_of_view_ = {};
  if (kind == PassKind::kColour && covers()) {
    find_edges(frame.views, size, drawn);
  }
  write_data(slot);
}

template <class Use>
void SceneDrawing::for_each_surface(const Use& use) {
  std::uint32_t item = 0;
  for (const auto* meshes : {&items_.translucent_meshes(), &items_.solids()}) {
    for (const MeshDraw& draw : *meshes) {
      const GpuMesh* copy = meshes_.find(draw.item->mesh);
      if (copy != nullptr && !copy->levels.empty()) {
        use(copy->levels[draw.level].edges,
            PlacedSurface{item++, meshes == &items_.translucent_meshes(),
                          draw.item->world_from_model});
      }
    }
  }
}

void SceneDrawing::find_edges(const std::vector<View>& views, PixelSize size, DrawnViews drawn) {
  const auto number = [](std::size_t count) { return static_cast<std::uint32_t>(count); };
  for (std::size_t i = drawn.first; i < drawn.first + drawn.count; ++i) {
    const std::uint32_t first = number(edges_.size());
    hidden_edges_.clear();
    for_each_surface([&](const SurfaceEdges& of, const PlacedSurface& surface) {
      of.hide(views[i], size, surface, edge_scratch_, hidden_edges_);
    });
    for_each_surface([&](const SurfaceEdges& of, const PlacedSurface& surface) {
      of.seen_by(views[i], size, surface, hidden_edges_, edge_scratch_, edges_);
    });
    edges_of_view_[i] = {number(items_.data().size()) + first, number(edges_.size()) - first};
  }
}

void SceneDrawing::write_data(FrameSlot& slot) const {
  const std::size_t item_bytes = items_.data().size() * sizeof(Float4);
  const std::size_t bytes = item_bytes + edges_.size() * sizeof(Float4);
  if (slot.data.size() < bytes || slot.data.size() == 0) {
    slot.data =
        Buffer(device_, grown(bytes), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, BufferPlace::kUpload);
    slot.bindings.bind_data(slot.data);
  }
  slot.data.write(items_.data().data(), item_bytes);
  if (!edges_.empty()) {
    slot.data.write(edges_.data(), bytes - item_bytes, item_bytes);
  }
  const std::size_t index_bytes = std::size_t{kLineIndexBytes} * items_.most_segments();
  if (slot.line_indices.size() < index_bytes || slot.line_indices.size() == 0) {
    slot.line_indices =
        Buffer(device_, grown(index_bytes), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, BufferPlace::kUpload);
    write_line_indices(slot.line_indices);
  }
}

void SceneDrawing::place(std::span<const View> views, std::size_t first, PixelSize size,
                         FrameSlot& slot) {
  items_.place(views, size, [this](const MeshItem& item) {
    const GpuMesh* copy = meshes_.find(item.mesh);
    return copy != nullptr ? copy->box : Box{};
  });
  const auto width = static_cast<float>(size.width_px);
  const auto height = static_cast<float>(size.height_px);
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
  frame.mode = {options_.blend == Blend::kAdditive ? 0u : 1u, 0, 0, 0};
  slot.frames.write(&frame, sizeof(frame), first * kFrameStride);
}

}  // namespace orthonav::render
