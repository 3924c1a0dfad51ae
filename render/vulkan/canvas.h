#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "render/vulkan/scene_drawing.h"

namespace orthonav::render {

/// How what is drawn is put into images.
struct Look {
  Blend blend = Blend::kAdditive;
  Edges edges = Edges::kCoverage;
  float clear_alpha = 1;  ///< of a pixel without hologram
};

/// The images that frames end in, with what belongs to the frames on their way there: images of its
/// own, of which the regions that hold holograms are drawn and read back, or images that others
/// made, which are drawn whole.
class Canvas {
 public:
  /// Of these chains or, if there are none, of its own images of this size. As many frames as
  /// `frames` may be in flight. Throws Failure, as the other calls do; `drawing` must outlive it.
  Canvas(SceneDrawing& drawing, const EyeImages& images, const Look& look, std::size_t frames);

  [[nodiscard]] PixelSize size() const { return {images_.width_px, images_.height_px}; }
  /// Whether each chain has an image with its index, the chains of depth after the others.
  [[nodiscard]] bool holds(std::span<const std::uint32_t> indices) const;
  /// Waits until the device has drawn the oldest frame; the next one takes its place.
  void wait();
  /// Waits until the device has drawn every frame.
  void wait_for_all();
  /// Lays the frame out, records those of its views that are `drawn`, and submits them. `indices`:
  /// the images of the chains. `wait` must come before the next one.
  void submit(PassKind kind, const Frame& frame, DrawnViews drawn,
              std::span<const std::uint32_t> indices = {});
  /// Milliseconds that submitting it took.
  [[nodiscard]] double submit_ms() const { return slots_[now_]->commands.submit_ms(); }
  /// What was read back of a view: a whole image, of which only the regions are valid.
  [[nodiscard]] const std::byte* read(std::size_t view) const {
    return readback_.mapped() + view * image_bytes();
  }
  [[nodiscard]] std::span<const PixelRect> regions(std::size_t view) const {
    return regions_[view];
  }

 private:
  [[nodiscard]] bool own() const { return images_.chains.empty(); }
  [[nodiscard]] std::size_t image_bytes() const {
    return 4 * static_cast<std::size_t>(images_.width_px) * images_.height_px;
  }
  [[nodiscard]] DeviceImage sampled_image(VkFormat format) const;
  const FramePass& pass(PassKind kind, std::size_t views);
  void upload_backgrounds(VkCommandBuffer batch, std::span<const RgbaImage* const> backgrounds,
                          std::size_t first);

  SceneDrawing& drawing_;
  EyeImages images_;
  Look look_;
  std::vector<std::unique_ptr<FrameSlot>> slots_;
  std::size_t now_ = 0;
  std::size_t views_a_pass_;
  DeviceImage drawn_so_far_;  ///< where coverage is computed
  DeviceImage background_;    ///< once there is one, as its staging
  Buffer background_staging_;
  Buffer readback_;
  std::array<std::unique_ptr<FramePass>, 6> passes_;       ///< by kind and number of views
  std::array<std::vector<PixelRect>, kMaxViews> regions_;  ///< of each view
};

}  // namespace orthonav::render
