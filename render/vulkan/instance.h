#pragma once

#include <vulkan/vulkan.h>

#include <memory>
#include <string>
#include <vector>

#include "render/renderer.h"

namespace orthonav::render {

/// A host's answer; a null handle becomes an Error.
[[nodiscard]] Result<void*> handle_of(Result<void*> answer);

/// The entry to Vulkan: an instance, with the validation layer if requested.
class Instance {
 public:
  /// Throws Failure if there is no Vulkan, or no validation layer although requested. Messages go
  /// to `messages`, or to its own sink if that is empty. With a host, the host makes it.
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
