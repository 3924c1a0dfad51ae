#include "hal/openxr/runtime.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "hal/openxr/xr_error.h"

namespace orthonav::openxr {
namespace {

constexpr std::array<const char*, 2> kNeeded = {XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME,
                                                XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME};
// Enabled if offered. Some are newer than the loader's headers.
constexpr std::array<const char*, 7> kWelcome = {XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME,
                                                 XR_MSFT_HAND_INTERACTION_EXTENSION_NAME,
                                                 XR_EXT_HAND_TRACKING_EXTENSION_NAME,
                                                 XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME,
                                                 "XR_EXT_hand_interaction",
                                                 "XR_ML_ml2_controller_interaction",
                                                 "XR_EXT_local_floor"};

Error no_runtime(XrResult result) {
  return Error{"openxr: no runtime answers (" + name_of(result) +
               "): start the headset's, or Monado, and name its manifest in XR_RUNTIME_JSON or "
               "~/.config/openxr/1/active_runtime.json"};
}

Result<std::vector<std::string>> offered_extensions() {
  std::uint32_t count = 0;
  XrResult result = xrEnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr);
  if (XR_FAILED(result)) {
    return no_runtime(result);
  }
  std::vector<XrExtensionProperties> properties(count, {XR_TYPE_EXTENSION_PROPERTIES});
  result = xrEnumerateInstanceExtensionProperties(nullptr, count, &count, properties.data());
  if (XR_FAILED(result)) {
    return no_runtime(result);
  }
  std::vector<std::string> names;
  names.reserve(properties.size());
  for (const XrExtensionProperties& property : properties) {
    names.emplace_back(property.extensionName);
  }
  return names;
}

Result<std::vector<std::string>> wanted_extensions() {
  const auto offered = offered_extensions();
  if (!offered) {
    return offered.error();
  }
  const auto is_offered = [&](const char* name) {
    return std::find(offered->begin(), offered->end(), name) != offered->end();
  };
  std::vector<std::string> wanted;
  for (const char* name : kNeeded) {
    if (!is_offered(name)) {
      return Error{std::string("openxr: the runtime has no ") + name + ", which is needed"};
    }
    wanted.emplace_back(name);
  }
  for (const char* name : kWelcome) {
    if (is_offered(name)) {
      wanted.emplace_back(name);
    }
  }
  return wanted;
}

/// Both results of a call that makes a Vulkan object.
Status checked(const char* what, XrResult result, VkResult vulkan) {
  if (XR_FAILED(result)) {
    return error_of(what, result);
  }
  if (vulkan != 0) {
    return Error{std::string("openxr: ") + what + ": VkResult " + std::to_string(vulkan)};
  }
  return {};
}

VulkanVersion version_of(XrVersion version) {
  return {static_cast<std::uint32_t>(XR_VERSION_MAJOR(version)),
          static_cast<std::uint32_t>(XR_VERSION_MINOR(version))};
}

}  // namespace

Result<std::unique_ptr<Runtime>> Runtime::connect() {
  // The loader prints errors on standard error; here they become an Error instead. A user who has
  // set the variable still gets the output.
  ::setenv("XR_LOADER_DEBUG", "none", 0);  // NOLINT(concurrency-mt-unsafe): our only call
  auto extensions = wanted_extensions();
  if (!extensions) {
    return extensions.error();
  }
  std::vector<const char*> names;
  for (const std::string& name : *extensions) {
    names.push_back(name.c_str());
  }
  XrInstanceCreateInfo info = {XR_TYPE_INSTANCE_CREATE_INFO};
  std::snprintf(info.applicationInfo.applicationName, XR_MAX_APPLICATION_NAME_SIZE, "orthonav");
  info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
  info.enabledExtensionCount = static_cast<std::uint32_t>(names.size());
  info.enabledExtensionNames = names.data();
  XrInstance instance = XR_NULL_HANDLE;
  const XrResult created = xrCreateInstance(&info, &instance);
  if (XR_FAILED(created)) {
    return no_runtime(created);
  }
  std::unique_ptr<Runtime> runtime(new Runtime(instance, std::move(*extensions)));
  XrInstanceProperties properties = {XR_TYPE_INSTANCE_PROPERTIES};
  const XrResult told = xrGetInstanceProperties(instance, &properties);
  if (XR_FAILED(told)) {
    return error_of("ask the runtime for its name", told);
  }
  runtime->name_ =
      std::string(properties.runtimeName) + " " + version_text(properties.runtimeVersion);
  if (const Status loaded = runtime->load_functions(); !loaded) {
    return loaded.error();
  }
  return runtime;
}

Runtime::~Runtime() { xrDestroyInstance(instance_); }

Status Runtime::load_functions() {
  Functions& f = functions_;
  if (load("xrConvertTimespecTimeToTimeKHR", f.time_from_timespec) &&
      load("xrGetVulkanGraphicsRequirements2KHR", f.requirements) &&
      load("xrCreateVulkanInstanceKHR", f.create_instance) &&
      load("xrGetVulkanGraphicsDevice2KHR", f.graphics_device) &&
      load("xrCreateVulkanDeviceKHR", f.create_device)) {
    return {};
  }
  return error_of("load the functions of its extensions", XR_ERROR_FUNCTION_UNSUPPORTED);
}

bool Runtime::has(const char* extension) const {
  return std::find(extensions_.begin(), extensions_.end(), extension) != extensions_.end();
}

Status Runtime::find_headset() {
  XrSystemGetInfo info = {XR_TYPE_SYSTEM_GET_INFO};
  info.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
  const XrResult found = xrGetSystem(instance_, &info, &system_);
  if (found == XR_ERROR_FORM_FACTOR_UNAVAILABLE) {
    return Error{"openxr: " + name_ + " has no headset at the moment: plug it in or put it on"};
  }
  return status_of("look for a headset", found);
}

Result<HeadsetTraits> Runtime::headset_traits() const {
  XrSystemProperties properties = {XR_TYPE_SYSTEM_PROPERTIES};
  XrSystemEyeGazeInteractionPropertiesEXT eyes = {
      XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT};
  XrSystemHandTrackingPropertiesEXT hands = {XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT};
  // A structure may be chained only if its extension is enabled.
  if (has(XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME)) {
    eyes.next = std::exchange(properties.next, &eyes);
  }
  if (has(XR_EXT_HAND_TRACKING_EXTENSION_NAME)) {
    hands.next = std::exchange(properties.next, &hands);
  }
  const XrResult told = xrGetSystemProperties(instance_, system_, &properties);
  if (XR_FAILED(told)) {
    return error_of("ask the headset for its properties", told);
  }
  const XrSystemGraphicsProperties& graphics = properties.graphicsProperties;
  return HeadsetTraits{properties.systemName,
                       graphics.maxLayerCount,
                       {static_cast<int>(graphics.maxSwapchainImageWidth),
                        static_cast<int>(graphics.maxSwapchainImageHeight)},
                       eyes.supportsEyeGazeInteraction == XR_TRUE,
                       hands.supportsHandTracking == XR_TRUE};
}

Result<XrTime> Runtime::now() const {
  timespec monotonic = {};
  ::clock_gettime(CLOCK_MONOTONIC, &monotonic);
  XrTime time = 0;
  const XrResult converted = functions_.time_from_timespec(instance_, &monotonic, &time);
  if (XR_FAILED(converted)) {
    return error_of("ask for the runtime's time", converted);
  }
  return time;
}

Result<std::array<VulkanVersion, 2>> Runtime::vulkan_versions() const {
  XrGraphicsRequirementsVulkan2KHR needs = {XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR};
  const XrResult told = functions_.requirements(instance_, system_, &needs);
  if (XR_FAILED(told)) {
    return error_of("ask for the Vulkan that it needs", told);
  }
  return std::array<VulkanVersion, 2>{version_of(needs.minApiVersionSupported),
                                      version_of(needs.maxApiVersionSupported)};
}

Result<void*> Runtime::create_vulkan_instance(VulkanFunction get_proc, const void* info) const {
  XrVulkanInstanceCreateInfoKHR create = {XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR};
  create.systemId = system_;
  create.pfnGetInstanceProcAddr = get_proc;
  create.vulkanCreateInfo = static_cast<const VkInstanceCreateInfo*>(info);
  VkInstance made = nullptr;
  VkResult vulkan = 0;
  const XrResult result = functions_.create_instance(instance_, &create, &made, &vulkan);
  if (const Status status = checked("create a Vulkan instance", result, vulkan); !status) {
    return status.error();
  }
  return static_cast<void*>(made);
}

Result<void*> Runtime::vulkan_device(void* vulkan_instance) const {
  XrVulkanGraphicsDeviceGetInfoKHR get = {XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR};
  get.systemId = system_;
  get.vulkanInstance = static_cast<VkInstance>(vulkan_instance);
  VkPhysicalDevice physical = nullptr;
  const XrResult result = functions_.graphics_device(instance_, &get, &physical);
  if (XR_FAILED(result)) {
    return error_of("ask for its graphics device", result);
  }
  return static_cast<void*>(physical);
}

Result<void*> Runtime::create_vulkan_device(void* physical, VulkanFunction get_proc,
                                            const void* info) const {
  XrVulkanDeviceCreateInfoKHR create = {XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR};
  create.systemId = system_;
  create.pfnGetInstanceProcAddr = get_proc;
  create.vulkanPhysicalDevice = static_cast<VkPhysicalDevice>(physical);
  create.vulkanCreateInfo = static_cast<const VkDeviceCreateInfo*>(info);
  VkDevice made = nullptr;
  VkResult vulkan = 0;
  const XrResult result = functions_.create_device(instance_, &create, &made, &vulkan);
  if (const Status status = checked("create a Vulkan device", result, vulkan); !status) {
    return status.error();
  }
  return static_cast<void*>(made);
}

}  // namespace orthonav::openxr
