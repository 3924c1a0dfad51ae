#include "render/vulkan/instance.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <utility>

#include "render/vulkan/failure.h"

namespace orthonav::render {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

// More lines tell nothing new, and a frame loop would fill the memory.
constexpr std::size_t kMaxMessages = 200;

// Advice that does not apply here; everything else that the layer reports is passed on.
constexpr std::array<std::string_view, 4> kUseless = {
    // The extension through which the layer reports.
    "UNASSIGNED-BestPractices-vkCreateInstance-specialuse-extension-debugging",
    // There are a few dozen small buffers, all kept; a device has room for at least 4096
    // allocations.
    "UNASSIGNED-BestPractices-vkAllocateMemory-small-allocation",
    "UNASSIGNED-BestPractices-vkBindMemory-small-dedicated-allocation",
    // One vertex shader serves depth, colour and labels, so that they agree to the bit; a driver
    // drops outputs that a fragment shader does not read.
    "UNASSIGNED-CoreValidation-Shader-OutputNotConsumed"};

bool is_useless(const char* id) {
  return id != nullptr && std::find(kUseless.begin(), kUseless.end(), id) != kUseless.end();
}

VKAPI_ATTR VkBool32 VKAPI_CALL listen(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                      VkDebugUtilsMessageTypeFlagsEXT,
                                      const VkDebugUtilsMessengerCallbackDataEXT* data,
                                      void* messages) {
  if (is_useless(data->pMessageIdName)) {
    return VK_FALSE;
  }
  auto& lines = *static_cast<std::vector<std::string>*>(messages);
  std::string line = data->pMessage != nullptr ? data->pMessage : "";
  std::replace(line.begin(), line.end(), '\n', ' ');
  if (lines.size() < kMaxMessages) {
    lines.push_back(std::move(line));
  }
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(std::vector<std::string>& messages) {
  VkDebugUtilsMessengerCreateInfoEXT info = {};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                     VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = listen;
  info.pUserData = &messages;
  return info;
}

constexpr std::array<VkValidationFeatureEnableEXT, 2> kEnabled = {
    VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT,
    VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT};

VkValidationFeaturesEXT features_for(const VkDebugUtilsMessengerCreateInfoEXT& listener) {
  VkValidationFeaturesEXT features = {};
  features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features.pNext = &listener;
  features.enabledValidationFeatureCount = static_cast<std::uint32_t>(kEnabled.size());
  features.pEnabledValidationFeatures = kEnabled.data();
  return features;
}

bool has_validation_layer() {
  std::uint32_t count = 0;
  if (vkEnumerateInstanceLayerProperties(&count, nullptr) != VK_SUCCESS) {
    return false;
  }
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
    return std::strcmp(layer.layerName, kValidationLayer) == 0;
  });
}

/// The version that the renderer needs, or a higher one that the host needs.
std::uint32_t api_version_for(const VulkanHost* host) {
  if (host == nullptr) {
    return VK_API_VERSION_1_1;
  }
  const auto [least, most] = host->versions();
  const auto packed = [](VulkanVersion v) { return VK_MAKE_API_VERSION(0, v.major, v.minor, 0); };
  if (packed(most) < VK_API_VERSION_1_1) {
    throw Failure(Error{"renderer: the host allows Vulkan " + std::to_string(most.major) + "." +
                        std::to_string(most.minor) + " at the most, needs 1.1"});
  }
  return std::max(packed(least), VK_API_VERSION_1_1);
}

VkInstance made_by(VulkanHost& host, const VkInstanceCreateInfo& info) {
  const auto get = reinterpret_cast<VulkanFunction>(vkGetInstanceProcAddr);
  return static_cast<VkInstance>(value_of(handle_of(host.create_instance(get, &info))));
}

}  // namespace

Result<void*> handle_of(Result<void*> answer) {
  if (answer && *answer == nullptr) {
    return Error{"renderer: the host answers with a null handle"};
  }
  return answer;
}

Instance::Instance(bool validation, MessageSink messages, VulkanHost* host)
    : messages_(messages ? std::move(messages) : std::make_shared<std::vector<std::string>>()) {
  if (validation && !has_validation_layer()) {
    throw Failure(VK_ERROR_LAYER_NOT_PRESENT, "validation layer");
  }
  VkApplicationInfo application = {};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "orthonav";
  application.apiVersion = api_version_for(host);
  VkDebugUtilsMessengerCreateInfoEXT listener = messenger_info(*messages_);
  const VkValidationFeaturesEXT features = features_for(listener);
  const std::array<const char*, 2> extensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME,
                                                 VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
  VkInstanceCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  if (validation) {
    info.pNext = &features;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kValidationLayer;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
  }
  if (host != nullptr) {
    instance_ = made_by(*host, info);
  } else {
    check(vkCreateInstance(&info, nullptr, &instance_), "Vulkan");
  }
  if (!validation) {
    return;
  }
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
  if (create == nullptr || create(instance_, &listener, nullptr, &messenger_) != VK_SUCCESS) {
    vkDestroyInstance(instance_, nullptr);
    throw Failure(VK_ERROR_EXTENSION_NOT_PRESENT, "validation messages");
  }
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    if (destroy != nullptr) {
      destroy(instance_, messenger_, nullptr);
    }
  }
  vkDestroyInstance(instance_, nullptr);
}

std::vector<VkPhysicalDevice> Instance::devices() const {
  std::uint32_t count = 0;
  check(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "list of Vulkan devices");
  std::vector<VkPhysicalDevice> devices(count);
  check(vkEnumeratePhysicalDevices(instance_, &count, devices.data()), "list of Vulkan devices");
  return devices;
}

}  // namespace orthonav::render
