#include "render/vulkan/memory.h"

#include <cstring>

#include "base/check.h"
#include "render/vulkan/failure.h"

namespace orthonav::render {
namespace {

DeviceMemory allocated(const Device& device, const VkMemoryRequirements& needs,
                       VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred) {
  VkMemoryAllocateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = needs.size;
  info.memoryTypeIndex = device.memory_type(needs.memoryTypeBits, required, preferred);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vkAllocateMemory(device.get(), &info, nullptr, &memory), "memory");
  return {device.get(), memory};
}

constexpr VkMemoryPropertyFlags kMapped =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

}  // namespace

Buffer::Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, BufferPlace place)
    : size_(size) {
  VkBufferCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = size;
  info.usage = usage;
  VkBuffer buffer = VK_NULL_HANDLE;
  check(vkCreateBuffer(device.get(), &info, nullptr, &buffer), "buffer");
  buffer_ = BufferHandle(device.get(), buffer);
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device.get(), buffer, &needs);
  if (place == BufferPlace::kDevice) {
    memory_ = allocated(device, needs, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  } else {
    // Reading uncached memory is very slow.
    const VkMemoryPropertyFlags preferred =
        place == BufferPlace::kReadback ? VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_HOST_CACHED_BIT}
                                        : 0;
    memory_ = allocated(device, needs, kMapped, preferred);
  }
  check(vkBindBufferMemory(device.get(), buffer, memory_.get(), 0), "buffer");
  if (place == BufferPlace::kDevice) {
    return;
  }
  void* mapped = nullptr;
  check(vkMapMemory(device.get(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &mapped), "buffer");
  mapped_ = static_cast<std::byte*>(mapped);
}

void Buffer::write(const void* bytes, std::size_t count, std::size_t offset) const {
  ORTHONAV_CHECK(mapped_ != nullptr && offset + count <= size_);
  if (count > 0) {
    std::memcpy(mapped_ + offset, bytes, count);
  }
}

DeviceImage::DeviceImage(const Device& device, const ImageSpec& spec) {
  VkImageCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = spec.format;
  info.extent = {spec.width, spec.height, 1};
  info.mipLevels = 1;
  info.arrayLayers = spec.layers;
  info.samples = spec.samples;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = spec.usage;
  info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkImage image = VK_NULL_HANDLE;
  check(vkCreateImage(device.get(), &info, nullptr, &image), "image");
  image_ = ImageHandle(device.get(), image);
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device.get(), image, &needs);
  memory_ = allocated(device, needs, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  check(vkBindImageMemory(device.get(), image, memory_.get(), 0), "image");
  VkImageViewCreateInfo view_info = {};
  view_info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  view_info.image = image;
  view_info.viewType = spec.view;
  view_info.format = spec.format;
  view_info.subresourceRange = {spec.aspect, 0, 1, 0, spec.layers};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(device.get(), &view_info, nullptr, &view), "image");
  view_ = ImageView(device.get(), view);
}

}  // namespace orthonav::render
