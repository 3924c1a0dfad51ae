#include "tests/support/image_chain.h"

#include <cstdio>
#include <cstdlib>

namespace orthonav::test {
namespace {

void expect(VkResult result, const char* what) {
  if (result == VK_SUCCESS) {
    return;
  }
  std::fprintf(stderr, "image chain: %s: VkResult %d\n", what, static_cast<int>(result));
  std::abort();
}

VkImageMemoryBarrier barrier(VkImage image, VkImageAspectFlags aspect, std::uint32_t layer,
                             bool reads) {
  const bool colour = aspect == VK_IMAGE_ASPECT_COLOR_BIT;
  const VkImageLayout attached = colour ? VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL
                                        : VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
  const VkAccessFlags written =
      colour ? VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT : VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  VkImageMemoryBarrier change = {};
  change.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
  change.srcAccessMask = reads ? written : 0;
  change.dstAccessMask = reads ? VkAccessFlags{VK_ACCESS_TRANSFER_READ_BIT} : 0;
  change.oldLayout = reads ? attached : VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  change.newLayout = reads ? VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL : attached;
  change.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  change.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  change.image = image;
  change.subresourceRange = {aspect, 0, 1, layer, 1};
  return change;
}

constexpr VkPipelineStageFlags kAttached =
    VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;

}  // namespace

ImageChain::ImageChain(const VulkanObjects& objects, VkFormat format, int width_px, int height_px,
                       std::uint32_t layers, std::size_t count, VkImageAspectFlags aspect)
    : objects_(objects),
      device_(static_cast<VkDevice>(objects.device)),
      width_px_(width_px),
      height_px_(height_px),
      layers_(layers),
      aspect_(aspect) {
  vkGetDeviceQueue(device_, objects.queue_family, objects.queue_index, &queue_);
  for (std::size_t i = 0; i < count; ++i) {
    add_image(format);
  }
  make_readback();
}

void ImageChain::add_image(VkFormat format) {
  VkImageCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {static_cast<std::uint32_t>(width_px_), static_cast<std::uint32_t>(height_px_), 1};
  info.mipLevels = 1;
  info.arrayLayers = layers_;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage =
      VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
      (layers_ > 1 && aspect_ == VK_IMAGE_ASPECT_COLOR_BIT ? VK_IMAGE_USAGE_TRANSFER_DST_BIT : 0) |
      (aspect_ == VK_IMAGE_ASPECT_COLOR_BIT ? VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT
                                            : VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
  VkImage image = VK_NULL_HANDLE;
  expect(vkCreateImage(device_, &info, nullptr, &image), "image");
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device_, image, &needs);
  expect(vkBindImageMemory(device_, image, memory_for(needs, 0), 0), "image");
  images_.push_back(image);
}

VkDeviceMemory ImageChain::memory_for(const VkMemoryRequirements& needs,
                                      VkMemoryPropertyFlags flags) {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(static_cast<VkPhysicalDevice>(objects_.physical), &memory);
  std::uint32_t type = 0;
  while (type < memory.memoryTypeCount &&
         ((needs.memoryTypeBits >> type & 1u) == 0 ||
          (memory.memoryTypes[type].propertyFlags & flags) != flags)) {
    ++type;
  }
  const VkMemoryAllocateInfo wanted = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
                                       type};
  memory_.emplace_back();
  expect(vkAllocateMemory(device_, &wanted, nullptr, &memory_.back()), "memory");
  return memory_.back();
}

void ImageChain::make_readback() {
  VkBufferCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = 8ul * width_px_ * height_px_;
  info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  expect(vkCreateBuffer(device_, &info, nullptr, &buffer_), "buffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device_, buffer_, &needs);
  const VkDeviceMemory memory =
      memory_for(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  expect(vkBindBufferMemory(device_, buffer_, memory, 0), "buffer");
  void* mapped = nullptr;
  expect(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &mapped), "buffer");
  mapped_ = static_cast<std::uint8_t*>(mapped);
  VkCommandPoolCreateInfo pool = {};
  pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool.queueFamilyIndex = objects_.queue_family;
  expect(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "pool");
}

ImageChain::~ImageChain() {
  vkDeviceWaitIdle(device_);
  for (VkImage image : images_) {
    vkDestroyImage(device_, image, nullptr);
  }
  vkDestroyBuffer(device_, buffer_, nullptr);
  vkDestroyCommandPool(device_, pool_, nullptr);
  for (VkDeviceMemory memory : memory_) {
    vkFreeMemory(device_, memory, nullptr);
  }
}

std::vector<std::uint64_t> ImageChain::handles() const {
  std::vector<std::uint64_t> handles;
  for (VkImage image : images_) {
    handles.push_back(reinterpret_cast<std::uint64_t>(image));
  }
  return handles;
}

void ImageChain::copy_layer(VkCommandBuffer commands, VkImage image, std::uint32_t layer) {
  const auto there = barrier(image, aspect_, layer, true);
  vkCmdPipelineBarrier(commands, kAttached, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0,
                       nullptr, 1, &there);
  VkBufferImageCopy copy = {};
  copy.imageSubresource = {aspect_, 0, layer, 1};
  copy.imageExtent = {static_cast<std::uint32_t>(width_px_), static_cast<std::uint32_t>(height_px_),
                      1};
  vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer_, 1, &copy);
  const auto back = barrier(image, aspect_, layer, false);
  VkBufferMemoryBarrier seen = {};
  seen.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER;
  seen.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  seen.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  seen.srcQueueFamilyIndex = seen.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  seen.buffer = buffer_;
  seen.size = VK_WHOLE_SIZE;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                       VK_PIPELINE_STAGE_HOST_BIT | kAttached, 0, 0, nullptr, 1, &seen, 1, &back);
}

std::vector<std::uint8_t> ImageChain::read(std::size_t image, std::uint32_t layer,
                                           int pixel_bytes) {
  vkResetCommandPool(device_, pool_, 0);
  VkCommandBufferAllocateInfo wanted = {};
  wanted.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  wanted.commandPool = pool_;
  wanted.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  expect(vkAllocateCommandBuffers(device_, &wanted, &commands), "commands");
  VkCommandBufferBeginInfo begin = {};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  expect(vkBeginCommandBuffer(commands, &begin), "commands");
  copy_layer(commands, images_[image], layer);
  expect(vkEndCommandBuffer(commands), "commands");
  VkSubmitInfo submit = {};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  expect(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), "submit");
  expect(vkQueueWaitIdle(queue_), "queue");
  vkFreeCommandBuffers(device_, pool_, 1, &commands);
  return {mapped_, mapped_ + static_cast<std::size_t>(pixel_bytes) * width_px_ * height_px_};
}

}  // namespace orthonav::test
