#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vulkan_handover.h"
#include "render/renderer.h"

namespace orthonav::render {

// Draws into images that the host owns, on a Vulkan device that the host makes: the swapchains of a
// headset's runtime.

/// Makes instance and device. A handle in an answer is never null.
class VulkanHost {
 public:
  virtual ~VulkanHost() = default;
  /// The oldest and the newest version that the host takes.
  [[nodiscard]] virtual std::array<VulkanVersion, 2> versions() const = 0;
  /// A VkInstance as described by a VkInstanceCreateInfo; the renderer destroys it.
  virtual Result<void*> create_instance(VulkanFunction get_instance_proc_addr,
                                        const void* info) = 0;
  /// The VkPhysicalDevice to be used.
  virtual Result<void*> physical_device(void* instance) = 0;
  /// A VkDevice as described by a VkDeviceCreateInfo; the renderer destroys it.
  virtual Result<void*> create_device(void* physical, VulkanFunction get_instance_proc_addr,
                                      const void* info) = 0;
};

/// Draws scenes into such images, two frames at a time: while the device draws one, the next is
/// recorded. One thread at a time, the one that the host allows to use the queue. Errors as in
/// Renderer.
class HostedRenderer {
 public:
  /// Of the options, only blend, edges, validation, messages, eyes_a_pass, surface_error_m and
  /// cache_folder are used. The host is asked during this call only; its errors are passed on
  /// unchanged.
  static Result<std::unique_ptr<HostedRenderer>> create(const RendererOptions& options,
                                                        VulkanHost& host);
  virtual ~HostedRenderer() = default;

  [[nodiscard]] virtual VulkanObjects objects() const = 0;
  /// How well images of this VkFormat suit: the higher the better; 0 if they can't be drawn into.
  /// sRGB formats are encoded, all others hold linear light.
  [[nodiscard]] virtual int format_score(std::int64_t format) const = 0;
  /// The same for depth images.
  [[nodiscard]] virtual int depth_format_score(std::int64_t format) const = 0;
  /// The images to draw into from now on; they must stay until the next call or `finish`. If
  /// coverage is computed they are also copied from; images of two layers may be copied into.
  virtual Status use(const EyeImages& images) = 0;
  /// Does the slow work that does not need the views: waits for the oldest frame in flight, checks
  /// the scene, uploads new meshes. `draw` of the same scene must follow.
  virtual Status prepare(const Scene& scene) = 0;
  /// Draws `scene` for both eyes into image `indices[i]` of chain i, the chains of depth after the
  /// others, and returns once the frame is submitted. The images are left as colour attachments,
  /// and as depth and stencil attachments.
  virtual Status draw(const Scene& scene, const std::vector<View>& views,
                      std::span<const std::uint32_t> indices, HeadTexts head_texts) = 0;
  /// Draws the texts of `scene` for one view into image `index` of the panel, between frames or
  /// between `prepare` and `draw`, and returns once they are submitted. Colours come out
  /// premultiplied, with their opacity as alpha; on an additive display alpha is 0, so that the
  /// panel is added to what lies below it.
  virtual Status draw_panel(const Scene& scene, const View& view, std::uint32_t index) = 0;
  /// Waits for every frame in flight and releases the images: the host may destroy them.
  virtual Status finish() = 0;

  /// The device is lost: every call fails from now on, with ErrorCode::kLost.
  [[nodiscard]] virtual bool lost() const = 0;
  [[nodiscard]] virtual const DeviceInfo& device() const = 0;
  /// The timing of the last frame; its time on the device is unknown.
  [[nodiscard]] virtual FrameTiming last_timing() const = 0;
  [[nodiscard]] virtual const std::vector<std::string>& validation_messages() const = 0;
  [[nodiscard]] virtual const std::vector<std::string>& notes() const = 0;
};

}  // namespace orthonav::render
