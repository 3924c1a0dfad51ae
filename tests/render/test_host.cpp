#include "tests/render/test_host.h"
#include "tests/support/test_device.h"

#include <array>
#include <cstring>

namespace orthonav::render {

Result<void*> TestHost::create_instance(VulkanFunction, const void* info) {
  const auto* asked = static_cast<const VkInstanceCreateInfo*>(info);
  asked_version = asked->pApplicationInfo->apiVersion;
  VkInstance instance = VK_NULL_HANDLE;
  if (vkCreateInstance(asked, nullptr, &instance) != VK_SUCCESS) {
    return Error{"no instance"};
  }
  return static_cast<void*>(instance);
}

Result<void*> TestHost::physical_device(void* instance) {
  std::uint32_t count = 8;
  std::array<VkPhysicalDevice, 8> devices = {};
  vkEnumeratePhysicalDevices(static_cast<VkInstance>(instance), &count, devices.data());
  for (std::uint32_t i = 0; i < count; ++i) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(devices[i], &properties);
    if (std::strstr(properties.deviceName, test::test_device().c_str()) != nullptr) {
      return static_cast<void*>(devices[i]);
    }
  }
  return Error{"no " + test::test_device()};
}

Result<void*> TestHost::create_device(void* physical, VulkanFunction, const void* info) {
  if (!refusal.empty()) {
    return Error{refusal, ErrorCode::kUnavailable};
  }
  VkDevice device = VK_NULL_HANDLE;
  const VkResult made =
      vkCreateDevice(static_cast<VkPhysicalDevice>(physical),
                     static_cast<const VkDeviceCreateInfo*>(info), nullptr, &device);
  if (made != VK_SUCCESS) {
    return Error{"no device"};
  }
  return static_cast<void*>(device);
}

TestImages::TestImages(const VulkanObjects& objects, VkFormat format, int width_px, int height_px,
                       std::uint32_t layers) {
  targets_ = {format, width_px, height_px, layers, {}};
  for (std::uint32_t chain = 0; chain < 2 / layers; ++chain) {
    chains_.push_back(
        std::make_unique<test::ImageChain>(objects, format, width_px, height_px, layers));
    targets_.chains.push_back(chains_.back()->handles());
  }
}

std::vector<std::uint8_t> TestImages::read(std::size_t eye, std::size_t image) {
  const bool layered = targets_.layers == 2;
  return chains_[layered ? 0 : eye]->read(image, layered ? static_cast<std::uint32_t>(eye) : 0);
}

}  // namespace orthonav::render
