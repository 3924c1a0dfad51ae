#include "render/vulkan/bindings.h"

#include <array>

#include "render/vulkan/failure.h"
#include "render/vulkan/gpu_types.h"

namespace orthonav::render {
namespace {

constexpr VkShaderStageFlags kBoth = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
constexpr std::array<VkDescriptorType, 5> kTypes = {
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};

Sampler make_sampler(VkDevice device, VkFilter filter) {
  VkSamplerCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  info.magFilter = filter;
  info.minFilter = filter;
  info.addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  VkSampler sampler = VK_NULL_HANDLE;
  check(vkCreateSampler(device, &info, nullptr, &sampler), "sampler");
  return {device, sampler};
}

DescriptorSetLayout make_set_layout(VkDevice device) {
  std::array<VkDescriptorSetLayoutBinding, kTypes.size()> bindings = {};
  for (std::uint32_t i = 0; i < bindings.size(); ++i) {
    bindings[i].binding = i;
    bindings[i].descriptorType = kTypes[i];
    bindings[i].descriptorCount = 1;
    bindings[i].stageFlags = kBoth;
  }
  VkDescriptorSetLayoutCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.bindingCount = static_cast<std::uint32_t>(bindings.size());
  info.pBindings = bindings.data();
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  check(vkCreateDescriptorSetLayout(device, &info, nullptr, &layout), "descriptor layout");
  return {device, layout};
}

PipelineLayout make_layout(VkDevice device, const VkDescriptorSetLayout& set_layout) {
  const VkPushConstantRange item = {kBoth, 0, sizeof(GpuItem)};
  VkPipelineLayoutCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &set_layout;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &item;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  check(vkCreatePipelineLayout(device, &info, nullptr, &layout), "pipeline layout");
  return {device, layout};
}

DescriptorPool make_pool(VkDevice device) {
  const std::array<VkDescriptorPoolSize, 3> sizes = {
      {{kTypes[0], 1}, {kTypes[1], 1}, {kTypes[2], 3}}};
  VkDescriptorPoolCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = 1;
  info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
  info.pPoolSizes = sizes.data();
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(device, &info, nullptr, &pool), "descriptor pool");
  return {device, pool};
}

}  // namespace

Bindings::Bindings(const Device& device)
    : device_(device.get()),
      smooth_(make_sampler(device_, VK_FILTER_LINEAR)),
      nearest_(make_sampler(device_, VK_FILTER_NEAREST)),
      set_layout_(make_set_layout(device_)),
      layout_(make_layout(device_, set_layout_.get())),
      pool_(make_pool(device_)) {
  VkDescriptorSetAllocateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = pool_.get();
  info.descriptorSetCount = 1;
  info.pSetLayouts = &set_layout_.get();
  check(vkAllocateDescriptorSets(device_, &info, &set_), "descriptor set");
}

void Bindings::bind_frames(const Buffer& frames) const {
  bind_buffer(0, frames.get(), sizeof(GpuFrame));
}
void Bindings::bind_data(const Buffer& data) const { bind_buffer(1, data.get(), VK_WHOLE_SIZE); }
void Bindings::bind_atlas(const DeviceImage& atlas) const {
  bind_image(2, atlas.view(), smooth_.get());
}
void Bindings::bind_background(const DeviceImage& background) const {
  bind_image(3, background.view(), nearest_.get());
}
void Bindings::bind_drawn(const DeviceImage& drawn) const {
  bind_image(4, drawn.view(), nearest_.get());
}

void Bindings::bind_buffer(std::uint32_t binding, VkBuffer buffer, VkDeviceSize range) const {
  const VkDescriptorBufferInfo info = {buffer, 0, range};
  write(binding, &info, nullptr);
}

void Bindings::bind_image(std::uint32_t binding, VkImageView view, VkSampler sampler) const {
  const VkDescriptorImageInfo info = {sampler, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  write(binding, nullptr, &info);
}

void Bindings::write(std::uint32_t binding, const VkDescriptorBufferInfo* buffer,
                     const VkDescriptorImageInfo* image) const {
  VkWriteDescriptorSet write = {};
  write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  write.dstSet = set_;
  write.dstBinding = binding;
  write.descriptorCount = 1;
  write.descriptorType = kTypes[binding];
  write.pBufferInfo = buffer;
  write.pImageInfo = image;
  vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
}

}  // namespace orthonav::render
