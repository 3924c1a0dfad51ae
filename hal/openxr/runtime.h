#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "hal/api/pixel_display.h"
#include "hal/openxr/xr.h"

namespace orthonav::openxr {

/// What the runtime says about the headset that it found.
struct HeadsetTraits {
  std::string name;  ///< "Simulated HMD"
  std::uint32_t most_layers = 1;
  std::array<int, 2> most_px{};  ///< of a swapchain: width, height
  bool sees_eyes = false;        ///< reports where they look
  bool sees_hands = false;       ///< reports their joints
};

/// The connection with the OpenXR runtime of this machine: an instance and, once it is found, the
/// headset. Its calls are thread-safe, as the runtime's are; no call may run while it is destroyed.
class Runtime {
 public:
  /// An Error if there is no runtime or it lacks a required feature.
  static Result<std::unique_ptr<Runtime>> connect();
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;

  /// "Monado(XRT) 21.0.0"
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] XrInstance instance() const { return instance_; }
  /// Whether this optional extension is enabled.
  [[nodiscard]] bool has(const char* extension) const;
  /// Finds a function of an enabled extension; false if the runtime lacks it.
  template <class Function>
  bool load(const char* name, Function& function) const {
    PFN_xrVoidFunction found = nullptr;
    const XrResult result = xrGetInstanceProcAddr(instance_, name, &found);
    function = XR_SUCCEEDED(result) ? reinterpret_cast<Function>(found) : nullptr;
    return function != nullptr;
  }

  /// Looks for a headset; it may be plugged in later.
  Status find_headset();
  [[nodiscard]] XrSystemId system() const { return system_; }
  [[nodiscard]] Result<HeadsetTraits> headset_traits() const;

  /// The runtime's time now. It counts from an epoch of its own.
  [[nodiscard]] Result<XrTime> now() const;

  // XR_KHR_vulkan_enable2
  [[nodiscard]] Result<std::array<VulkanVersion, 2>> vulkan_versions() const;
  Result<void*> create_vulkan_instance(VulkanFunction get_proc, const void* info) const;
  [[nodiscard]] Result<void*> vulkan_device(void* vulkan_instance) const;
  Result<void*> create_vulkan_device(void* physical, VulkanFunction get_proc,
                                     const void* info) const;

 private:
  struct Functions {
    PFN_xrConvertTimespecTimeToTimeKHR time_from_timespec = nullptr;
    PFN_xrGetVulkanGraphicsRequirements2KHR requirements = nullptr;
    PFN_xrCreateVulkanInstanceKHR create_instance = nullptr;
    PFN_xrGetVulkanGraphicsDevice2KHR graphics_device = nullptr;
    PFN_xrCreateVulkanDeviceKHR create_device = nullptr;
  };

  Runtime(XrInstance instance, std::vector<std::string> extensions)
      : instance_(instance), extensions_(std::move(extensions)) {}
  Status load_functions();

  XrInstance instance_ = XR_NULL_HANDLE;
  std::vector<std::string> extensions_;
  std::string name_;
  XrSystemId system_ = XR_NULL_SYSTEM_ID;
  Functions functions_;
};

}  // namespace orthonav::openxr
