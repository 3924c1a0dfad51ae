#include "render/vulkan/commands.h"

#include "base/stopwatch.h"
#include "render/vulkan/failure.h"

namespace orthonav::render {

Commands::Commands(const Device& device, std::chrono::nanoseconds patience)
    : device_(device.get()), queue_(device.queue()), patience_(patience) {
  VkCommandPoolCreateInfo pool_info = {};
  pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool_info.queueFamilyIndex = device.queue_family();
  VkCommandPool pool = VK_NULL_HANDLE;
  check(vkCreateCommandPool(device_, &pool_info, nullptr, &pool), "command pool");
  pool_ = CommandPool(device_, pool);
  VkCommandBufferAllocateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = pool;
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(device_, &info, &buffer_), "command buffer");
  VkFenceCreateInfo fence_info = {};
  fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  VkFence fence = VK_NULL_HANDLE;
  check(vkCreateFence(device_, &fence_info, nullptr, &fence), "fence");
  finished_ = Fence(device_, fence);
}

VkCommandBuffer Commands::begin() {
  check(vkResetCommandPool(device_, pool_.get(), 0), "command pool");
  VkCommandBufferBeginInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(buffer_, &info), "command buffer");
  return buffer_;
}

void Commands::run() {
  submit();
  wait();
}

void Commands::submit() {
  check(vkEndCommandBuffer(buffer_), "command buffer");
  check(vkResetFences(device_, 1, &finished_.get()), "fence");
  VkSubmitInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.commandBufferCount = 1;
  info.pCommandBuffers = &buffer_;
  const Stopwatch watch;
  check(vkQueueSubmit(queue_, 1, &info, finished_.get()), "drawing");
  submit_ms_ = watch.elapsed_ms();
  underway_ = true;
}

void Commands::wait() {
  if (!underway_) {
    return;
  }
  underway_ = false;
  const VkResult result = vkWaitForFences(device_, 1, &finished_.get(), VK_TRUE,
                                          static_cast<std::uint64_t>(patience_.count()));
  if (result == VK_SUCCESS) {
    return;
  }
  // The batch can't be cancelled. Nothing that it reads may be destroyed before it ends or the
  // driver declares the device lost, however long that takes. The device counts as lost either way,
  // since waiting again would not help.
  vkDeviceWaitIdle(device_);
  if (result == VK_TIMEOUT) {
    throw Failure(VK_ERROR_DEVICE_LOST,
                  "drawing for over " + std::to_string(patience_.count() / 1'000'000) + " ms");
  }
  throw Failure(Error{Failure(result, "drawing").what(), ErrorCode::kLost});
}

void change_layout(VkCommandBuffer commands, const LayoutChange& change) {
  const bool to_shader = change.to == VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  VkImageMemoryBarrier barrier = {};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
  barrier.srcAccessMask = to_shader ? VkAccessFlags{VK_ACCESS_TRANSFER_WRITE_BIT} : 0;
  barrier.dstAccessMask = to_shader ? VK_ACCESS_SHADER_READ_BIT : VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.oldLayout = change.from;
  barrier.newLayout = change.to;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = change.image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, change.layers};
  const VkPipelineStageFlags before =
      to_shader ? VK_PIPELINE_STAGE_TRANSFER_BIT
                : VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
  const VkPipelineStageFlags after =
      to_shader ? VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT : VK_PIPELINE_STAGE_TRANSFER_BIT;
  vkCmdPipelineBarrier(commands, before, after, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

void fill_image(VkCommandBuffer commands, const ImageFill& fill,
                std::span<const PixelRect> regions) {
  change_layout(commands, {fill.to.get(), fill.layers, VK_IMAGE_LAYOUT_UNDEFINED,
                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL});
  for (const PixelRect& region : regions) {
    VkBufferImageCopy copy = {};
    copy.bufferOffset =
        fill.offset +
        fill.texel_bytes * (std::size_t{fill.extent.width} * region.top + region.left);
    copy.bufferRowLength = fill.extent.width;
    copy.bufferImageHeight = fill.extent.height;
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, fill.filled_layers};
    copy.imageOffset = {region.left, region.top, 0};
    copy.imageExtent = {static_cast<std::uint32_t>(region.width()),
                        static_cast<std::uint32_t>(region.height()), 1};
    vkCmdCopyBufferToImage(commands, fill.from.get(), fill.to.get(),
                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
  }
  change_layout(commands, {fill.to.get(), fill.layers, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
}

}  // namespace orthonav::render
