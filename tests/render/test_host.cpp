#include "tests/render/test_host.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>

namespace orthonav::render {
namespace {

void expect(VkResult result, const char* what) { ASSERT_EQ(result, VK_SUCCESS) << what; }

VkImageMemoryBarrier barrier(VkImage image, std::uint32_t layer, VkImageLayout from,
                             VkImageLayout to) {
  VkImageMemoryBarrier change = {};
  change.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
  const bool reads = to == VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  change.srcAccessMask = reads ? VkAccessFlags{VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT} : 0;
  change.dstAccessMask = reads ? VkAccessFlags{VK_ACCESS_TRANSFER_READ_BIT} : 0;
  change.oldLayout = from;
  change.newLayout = to;
  change.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  change.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  change.image = image;
  change.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, layer, 1};
  return change;
}

}  // namespace

void* TestHost::create_instance(VulkanFunction, const void* info, std::string& error) {
  const auto* asked = static_cast<const VkInstanceCreateInfo*>(info);
  asked_version = asked->pApplicationInfo->apiVersion;
  VkInstance instance = VK_NULL_HANDLE;
  if (vkCreateInstance(asked, nullptr, &instance) != VK_SUCCESS) error = "no instance";
  return instance;
}

void* TestHost::physical_device(void* instance, std::string& error) {
  std::uint32_t count = 8;
  std::array<VkPhysicalDevice, 8> devices = {};
  vkEnumeratePhysicalDevices(static_cast<VkInstance>(instance), &count, devices.data());
  for (std::uint32_t i = 0; i < count; ++i) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(devices[i], &properties);
    if (std::strstr(properties.deviceName, "llvmpipe") != nullptr) return devices[i];
  }
  error = "no llvmpipe";
  return nullptr;
}

void* TestHost::create_device(void* physical, VulkanFunction, const void* info,
                              std::string& error) {
  if (!refusal.empty()) return error = refusal, nullptr;
  VkDevice device = VK_NULL_HANDLE;
  const VkResult made =
      vkCreateDevice(static_cast<VkPhysicalDevice>(physical),
                     static_cast<const VkDeviceCreateInfo*>(info), nullptr, &device);
  if (made != VK_SUCCESS) error = "no device";
  return device;
}

TestImages::TestImages(const VulkanObjects& objects, VkFormat format, int width_px, int height_px,
                       std::uint32_t layers)
    : objects_(objects), device_(static_cast<VkDevice>(objects.device)) {
  vkGetDeviceQueue(device_, objects.queue_family, objects.queue_index, &queue_);
  targets_ = {format, width_px, height_px, layers, {}};
  for (std::uint32_t chain = 0; chain < 2 / layers; ++chain) {
    std::vector<std::uint64_t> images;
    for (int i = 0; i < 2; ++i) {
      VkImageCreateInfo info = {};
      info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
      info.imageType = VK_IMAGE_TYPE_2D;
      info.format = format;
      info.extent = {static_cast<std::uint32_t>(width_px), static_cast<std::uint32_t>(height_px),
                     1};
      info.mipLevels = 1;
      info.arrayLayers = layers;
      info.samples = VK_SAMPLE_COUNT_1_BIT;
      info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
      VkImage image = VK_NULL_HANDLE;
      expect(vkCreateImage(device_, &info, nullptr, &image), "image");
      VkMemoryRequirements needs;
      vkGetImageMemoryRequirements(device_, image, &needs);
      VkMemoryAllocateInfo wanted = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
                                     memory_type(needs.memoryTypeBits, 0)};
      memory_.emplace_back();
      expect(vkAllocateMemory(device_, &wanted, nullptr, &memory_.back()), "memory");
      expect(vkBindImageMemory(device_, image, memory_.back(), 0), "image");
      images.push_back(reinterpret_cast<std::uint64_t>(image));
    }
    targets_.chains.push_back(std::move(images));
  }
  make_readback();
}

void TestImages::make_readback() {
  VkBufferCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = 8ul * targets_.width_px * targets_.height_px;
  info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  expect(vkCreateBuffer(device_, &info, nullptr, &buffer_), "buffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device_, buffer_, &needs);
  VkMemoryAllocateInfo wanted = {
      VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
      memory_type(needs.memoryTypeBits,
                  VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT)};
  memory_.emplace_back();
  expect(vkAllocateMemory(device_, &wanted, nullptr, &memory_.back()), "memory");
  expect(vkBindBufferMemory(device_, buffer_, memory_.back(), 0), "buffer");
  void* mapped = nullptr;
  expect(vkMapMemory(device_, memory_.back(), 0, VK_WHOLE_SIZE, 0, &mapped), "buffer");
  mapped_ = static_cast<std::uint8_t*>(mapped);
  VkCommandPoolCreateInfo pool = {};
  pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool.queueFamilyIndex = objects_.queue_family;
  expect(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "pool");
}

TestImages::~TestImages() {
  vkDeviceWaitIdle(device_);
  for (const auto& chain : targets_.chains)
    for (const std::uint64_t image : chain)
      vkDestroyImage(device_, reinterpret_cast<VkImage>(image), nullptr);
  vkDestroyBuffer(device_, buffer_, nullptr);
  vkDestroyCommandPool(device_, pool_, nullptr);
  for (VkDeviceMemory memory : memory_) vkFreeMemory(device_, memory, nullptr);
}

std::uint32_t TestImages::memory_type(std::uint32_t allowed, VkMemoryPropertyFlags flags) const {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(static_cast<VkPhysicalDevice>(objects_.physical), &memory);
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    if ((allowed >> i & 1u) != 0 && (memory.memoryTypes[i].propertyFlags & flags) == flags)
      return i;
  return 0;
}

void TestImages::copy_layer(VkCommandBuffer commands, VkImage image, std::uint32_t layer) {
  const auto there = barrier(image, layer, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                             VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                       VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr, 1, &there);
  VkBufferImageCopy copy = {};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, layer, 1};
  copy.imageExtent = {static_cast<std::uint32_t>(targets_.width_px),
                      static_cast<std::uint32_t>(targets_.height_px), 1};
  vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer_, 1, &copy);
  const auto back = barrier(image, layer, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                            VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  VkBufferMemoryBarrier seen = {};
  seen.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER;
  seen.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  seen.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  seen.srcQueueFamilyIndex = seen.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  seen.buffer = buffer_;
  seen.size = VK_WHOLE_SIZE;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                       VK_PIPELINE_STAGE_HOST_BIT | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                       0, 0, nullptr, 1, &seen, 1, &back);
}

std::vector<std::uint8_t> TestImages::read(std::uint64_t image, std::uint32_t layer,
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
  copy_layer(commands, reinterpret_cast<VkImage>(image), layer);
  expect(vkEndCommandBuffer(commands), "commands");
  VkSubmitInfo submit = {};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  expect(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), "submit");
  expect(vkQueueWaitIdle(queue_), "queue");
  vkFreeCommandBuffers(device_, pool_, 1, &commands);
  return {mapped_,
          mapped_ + static_cast<std::size_t>(pixel_bytes) * targets_.width_px * targets_.height_px};
}

}  // namespace orthonav::render
