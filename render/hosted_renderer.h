#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "render/renderer.h"

namespace orthonav::render {

// Drawing into images that somebody else owns, on a Vulkan device that somebody else makes: the
// swapchains of a headset's runtime. Vulkan's handles pass as plain pointers and numbers, so that
// no Vulkan type leaves this folder; docs/decisions/0034-draw-on-the-runtimes-device.md.

/// Any function of Vulkan's; cast to what it is by who calls it.
using VulkanFunction = void (*)();

struct VulkanVersion {
  std::uint32_t major = 1;
  std::uint32_t minor = 1;
};

/// Who makes instance and device. Each answer is a handle, or null with a line in `error`.
class VulkanHost {
 public:
  virtual ~VulkanHost() = default;
  /// The least and the most that the host takes.
  [[nodiscard]] virtual std::array<VulkanVersion, 2> versions() const = 0;
  /// A VkInstance as described by a VkInstanceCreateInfo; the renderer destroys it.
  virtual void* create_instance(VulkanFunction get_instance_proc_addr, const void* info,
                                std::string& error) = 0;
  /// The VkPhysicalDevice to be used.
  virtual void* physical_device(void* instance, std::string& error) = 0;
  /// A VkDevice as described by a VkDeviceCreateInfo; the renderer destroys it.
  virtual void* create_device(void* physical, VulkanFunction get_instance_proc_addr,
                              const void* info, std::string& error) = 0;
};

/// What the host needs to know of the device that draws.
struct VulkanObjects {
  void* instance = nullptr;  ///< VkInstance
  void* physical = nullptr;  ///< VkPhysicalDevice
  void* device = nullptr;    ///< VkDevice
  std::uint32_t queue_family = 0;
  std::uint32_t queue_index = 0;
};

/// Images to draw into. A chain is a ring of images of which one is free at a time.
struct EyeTargets {
  std::int64_t format = 0;  ///< a VkFormat among `formats`
  int width_px = 0;
  int height_px = 0;
  /// Of each image. 2, where the renderer takes that: one chain for both eyes; 1: a chain an eye.
  std::uint32_t layers = 1;
  std::vector<std::vector<std::uint64_t>> chains;  ///< VkImage, single sample
  /// Images of the same size and layers that get the depth of what shows: 0 at `kNearPlane_m`, 1 at
  /// infinity. Chains like the others, or none.
  std::int64_t depth_format = 0;
  std::vector<std::vector<std::uint64_t>> depth_chains;
};

/// Draws scenes into such images, two frames at a time: while the device draws one, the next is
/// recorded. One thread at a time, the one that the host lets use the queue. Failures come back as
/// in Renderer.
class HostedRenderer {
 public:
  /// Nothing but blend, samples, validation, messages, eyes_a_pass, surface_error_m and
  /// cache_folder of the options counts. The host is asked during this call only.
  [[nodiscard]] static std::unique_ptr<HostedRenderer> create(const RendererOptions& options,
                                                              VulkanHost& host, std::string& error);
  virtual ~HostedRenderer() = default;

  [[nodiscard]] virtual VulkanObjects objects() const = 0;
  /// Whether images of this VkFormat can be drawn into, and how well they suit: the higher the
  /// better, 0 not at all. sRGB formats are encoded, all others hold linear light.
  [[nodiscard]] virtual int format_score(std::int64_t format) const = 0;
  /// The same of depth images.
  [[nodiscard]] virtual int depth_format_score(std::int64_t format) const = 0;
  /// Whether the device draws both eyes in one pass, into an image of two layers. If not, each eye
  /// gets a chain of its own: llvmpipe of Mesa 22.3 loses parts of the second layer.
  [[nodiscard]] virtual bool takes_layers() const = 0;
  /// The images to draw into from now on, which stay until the next call or `finish`.
  [[nodiscard]] virtual bool use(const EyeTargets& targets, std::string& error) = 0;
  /// What takes time before the views need to be known: waits for the oldest frame in flight,
  /// checks the scene, uploads new meshes. Then `draw` of the same scene follows.
  [[nodiscard]] virtual bool prepare(const Scene& scene, std::string& error) = 0;
  /// Draws `scene` for both eyes into image `images[i]` of chain i, those of depth after the
  /// others, and returns once the device has its orders. The images are left as colour attachments,
  /// and as depth and stencil attachments.
  [[nodiscard]] virtual bool draw(const Scene& scene, const std::vector<View>& views,
                                  std::span<const std::uint32_t> images, std::string& error) = 0;
  /// Waits for every frame in flight and lets go of the images: the host may destroy them.
  [[nodiscard]] virtual bool finish(std::string& error) = 0;

  /// The device is gone: every call fails from here on.
  [[nodiscard]] virtual bool lost() const = 0;
  [[nodiscard]] virtual const DeviceInfo& device() const = 0;
  /// Of the last frame; its device time is not known.
  [[nodiscard]] virtual FrameTiming last_timing() const = 0;
  [[nodiscard]] virtual const std::vector<std::string>& validation_messages() const = 0;
  [[nodiscard]] virtual const std::vector<std::string>& notes() const = 0;
};

}  // namespace orthonav::render
