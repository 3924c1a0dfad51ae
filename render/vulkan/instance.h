#pragma once

#include <vulkan/vulkan.h>

#include <memory>
#include <string>
#include <vector>

#include "render/hosted_renderer.h"
#include "render/renderer.h"

namespace orthonav::render {

/// The door to Vulkan: an instance, with the validation layer listening where it is asked for.
class Instance {
 public:
  /// Throws VulkanFailure when there is no Vulkan here, or no validation layer where asked for.
  /// Messages go to `messages`, or to a sink of its own where that is empty. With a host it is the
  /// host who makes it.
  explicit Instance(bool validation, MessageSink messages = nullptr, VulkanHost* host = nullptr);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  [[nodiscard]] VkInstance get() const { return instance_; }
  [[nodiscard]] std::vector<VkPhysicalDevice> devices() const;
  /// Warnings and errors of the validation layer, one line each.
  [[nodiscard]] const std::vector<std::string>& messages() const { return *messages_; }

 private:
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  MessageSink messages_;
};

}  // namespace orthonav::render
