#pragma once

#include "render/vulkan/device.h"
#include "render/vulkan/handle.h"
#include "render/vulkan/memory.h"

namespace orthonav::render {

/// The one descriptor set and pipeline layout that all pipelines share.
class Bindings {
 public:
  explicit Bindings(const Device& device);
  /// One GpuFrame per pass, kFrameStride apart.
  void bind_frames(const Buffer& frames) const;
  void bind_data(const Buffer& data) const;
  void bind_atlas(const DeviceImage& atlas) const;
  void bind_background(const DeviceImage& background) const;
  /// The image drawn so far, where edges of surfaces are smoothed.
  void bind_drawn(const DeviceImage& drawn) const;
  [[nodiscard]] VkPipelineLayout layout() const { return layout_.get(); }
  [[nodiscard]] const VkDescriptorSet& set() const { return set_; }

 private:
  void bind_buffer(std::uint32_t binding, VkBuffer buffer, VkDeviceSize range) const;
  void bind_image(std::uint32_t binding, VkImageView view, VkSampler sampler) const;
  void write(std::uint32_t binding, const VkDescriptorBufferInfo* buffer,
             const VkDescriptorImageInfo* image) const;

  VkDevice device_ = VK_NULL_HANDLE;
  Sampler smooth_;
  Sampler nearest_;
  DescriptorSetLayout set_layout_;
  PipelineLayout layout_;
  DescriptorPool pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace orthonav::render
