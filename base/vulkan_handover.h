#pragma once

#include <cstdint>
#include <vector>

namespace orthonav {

// What a display's runtime and a renderer hand each other when the runtime makes the Vulkan device
// and owns the images. Vulkan's handles are passed as plain pointers and numbers, so that neither
// side needs Vulkan's headers for it; docs/decisions/0034-draw-on-the-runtimes-device.md.

/// Any Vulkan function; the caller casts it to its own type.
using VulkanFunction = void (*)();

struct VulkanVersion {
  std::uint32_t major = 1;
  std::uint32_t minor = 1;
};

/// The device that draws, as the display's runtime needs to know it.
struct VulkanObjects {
  void* instance = nullptr;  ///< VkInstance
  void* physical = nullptr;  ///< VkPhysicalDevice
  void* device = nullptr;    ///< VkDevice
  std::uint32_t queue_family = 0;
  std::uint32_t queue_index = 0;
};

/// Images of a panel that the display itself lays over what the eyes' images show, in the eyes'
/// format.
struct PanelImages {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint64_t> chain;  ///< VkImage, single sample, one layer; empty: no panel
};

/// The display's images, for the renderer to draw into. A chain is a ring of images, one of which
/// is free at a time.
struct EyeImages {
  std::int64_t format = 0;  ///< VkFormat, one that the renderer gave a score above 0
  int width_px = 0;
  int height_px = 0;
  /// Layers of each image. 2: one chain for both eyes; 1: one chain per eye.
  std::uint32_t layers = 1;
  std::vector<std::vector<std::uint64_t>> chains;  ///< VkImage, single sample
  /// Images of the same size and layers for the depth of what is drawn: 0 at the renderer's near
  /// plane, 1 at infinity. As many chains as above, or none if the display does not ask for depth.
  std::int64_t depth_format = 0;
  std::vector<std::vector<std::uint64_t>> depth_chains;
  PanelImages panel;
};

}  // namespace orthonav
