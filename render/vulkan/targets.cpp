#include "render/vulkan/targets.h"

#include <array>

#include "render/vulkan/failure.h"

namespace orthonav::render {
namespace {

VkAttachmentDescription attachment(VkFormat format, VkSampleCountFlagBits samples,
                                   VkAttachmentLoadOp load, VkAttachmentStoreOp store,
                                   VkImageLayout final_layout) {
  VkAttachmentDescription description = {};
  description.format = format;
  description.samples = samples;
  description.loadOp = load;
  description.storeOp = store;
  description.stencilLoadOp = load;
  description.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  description.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  description.finalLayout = final_layout;
  return description;
}

VkSubpassDependency before_drawing() {
  VkSubpassDependency dependency = {};
  dependency.srcSubpass = VK_SUBPASS_EXTERNAL;
  dependency.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                            VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT |
                            VK_PIPELINE_STAGE_TRANSFER_BIT;
  dependency.dstStageMask =
      VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT;
  dependency.srcAccessMask =
      VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  dependency.dstAccessMask =
      VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT |
      VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  return dependency;
}

/// Before the result is copied; before the host samples or copies its image.
VkSubpassDependency before_reading(bool outer) {
  VkSubpassDependency dependency = {};
  dependency.dstSubpass = VK_SUBPASS_EXTERNAL;
  dependency.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  dependency.dstStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT;
  dependency.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  dependency.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
  if (outer) {
    dependency.dstStageMask |= VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
  }
  if (outer) {
    dependency.dstAccessMask |= VK_ACCESS_SHADER_READ_BIT;
  }
  return dependency;
}

/// Draws the views of a mask together; the returned info points to the mask.
VkRenderPassMultiviewCreateInfo all_at_once(const std::uint32_t& view_mask) {
  VkRenderPassMultiviewCreateInfo multiview = {};
  multiview.sType = VK_STRUCTURE_TYPE_RENDER_PASS_MULTIVIEW_CREATE_INFO;
  multiview.subpassCount = 1;
  multiview.pViewMasks = &view_mask;
  multiview.correlationMaskCount = 1;
  multiview.pCorrelationMasks = &view_mask;
  return multiview;
}

/// The aspects of an image that is drawn into.
VkImageAspectFlags aspects_of(VkFormat depth) {
  const bool stencil =
      depth == VK_FORMAT_D24_UNORM_S8_UINT || depth == VK_FORMAT_D32_SFLOAT_S8_UINT;
  return VK_IMAGE_ASPECT_DEPTH_BIT |
         (stencil ? VkImageAspectFlags{VK_IMAGE_ASPECT_STENCIL_BIT} : 0);
}

ImageView view_of(const Device& device, const TargetSpec& spec, VkImage outer,
                  std::uint32_t first_layer) {
  VkImageViewCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  info.image = outer;
  info.viewType = VK_IMAGE_VIEW_TYPE_2D_ARRAY;
  const bool depth = spec.kind == PassKind::kDepth;
  info.format = depth ? spec.depth : spec.colour;
  const VkImageAspectFlags aspects =
      depth ? aspects_of(spec.depth) : VkImageAspectFlags{VK_IMAGE_ASPECT_COLOR_BIT};
  info.subresourceRange = {aspects, 0, 1, first_layer, spec.views};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(device.get(), &info, nullptr, &view), "view of a host's image");
  return {device.get(), view};
}

}  // namespace

Targets::Targets(const Device& device, const TargetSpec& spec) : spec_(spec) {
  if (spec.kind == PassKind::kLabels) {
    spec_.colour = kLabelFormat;
  }
  for (std::size_t i = 0; i < spec_.outer.size() * spec_.passes_an_image(); ++i) {
    if (!copies_result()) {
      outer_.push_back(view_of(device, spec_, drawn(i), first_layer(i)));
    }
  }
  if (spec.kind == PassKind::kDepth) {
    make_depth_pass(device);
  } else {
    make_images(device);
    make_pass(device, PassPart::kWhole);
    if (spec_.covers()) {
      make_pass(device, PassPart::kOpening);
      make_pass(device, PassPart::kClosing);
    }
  }
  make_framebuffers(device);
}

void Targets::make_images(const Device& device) {
  ImageSpec image;
  image.format = spec_.colour;
  image.width = spec_.width;
  image.height = spec_.height;
  image.layers = spec_.views;
  image.samples = spec_.samples();
  image.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  if (!resolves()) {
    image.usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  }
  if (resolves() || spec_.outer.empty()) {
    colour_ = DeviceImage(device, image);
  }
  if (resolves() && (spec_.outer.empty() || copies_result())) {
    ImageSpec result = image;
    result.samples = VK_SAMPLE_COUNT_1_BIT;
    result.usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    result_ = DeviceImage(device, result);
  }
  ImageSpec depth = image;
  depth.format = device.depth_format();
  depth.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  depth.aspect = VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
  depth_ = DeviceImage(device, depth);
}

void Targets::make_framebuffers(const Device& device) {
  for (const ImageView& outer : outer_) {
    framebuffers_.push_back(framebuffer_of(device, outer.get()));
  }
  if (outer_.empty()) {
    framebuffers_.push_back(framebuffer_of(device, resolves() ? result_.view() : colour_.view()));
  }
}

/// `result`: the view that receives the final result.
Framebuffer Targets::framebuffer_of(const Device& device, VkImageView result) const {
  const std::array<VkImageView, 3> views = {resolves() ? colour_.view() : result, depth_.view(),
                                            result};
  VkFramebufferCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
  info.renderPass = pass();
  info.attachmentCount = resolves() ? 3 : 2;
  info.pAttachments = views.data();
  if (spec_.kind == PassKind::kDepth) {
    info.attachmentCount = 1;
    info.pAttachments = &result;
  }
  info.width = spec_.width;
  info.height = spec_.height;
  info.layers = 1;  // multiview picks the layers
  VkFramebuffer framebuffer = VK_NULL_HANDLE;
  check(vkCreateFramebuffer(device.get(), &info, nullptr, &framebuffer), "framebuffer");
  return {device.get(), framebuffer};
}

/// Colour, depth and, where samples are resolved, the result.
std::array<VkAttachmentDescription, 3> Targets::attachments(VkFormat depth, PassPart part) const {
  constexpr auto kDrop = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  constexpr auto kKeep = VK_ATTACHMENT_STORE_OP_STORE;
  const VkImageLayout read = spec_.outer.empty() || copies_result()
                                 ? VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL
                                 : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  std::array<VkAttachmentDescription, 3> described = {
      attachment(spec_.colour, spec_.samples(), VK_ATTACHMENT_LOAD_OP_CLEAR,
                 resolves() ? kDrop : kKeep,
                 resolves() ? VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL : read),
      attachment(depth, spec_.samples(), VK_ATTACHMENT_LOAD_OP_CLEAR, kDrop,
                 VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL),
      attachment(spec_.colour, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, kKeep,
                 read)};
  if (part == PassPart::kOpening) {
    described[0].finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    described[1].storeOp = kKeep;
  }
  if (part == PassPart::kClosing) {
    described[0].initialLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    described[1].initialLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    described[0].loadOp = described[1].loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    described[1].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  }
  return described;
}

void Targets::make_pass(const Device& device, PassPart part) {
  const auto described = attachments(device.depth_format(), part);
  const VkAttachmentReference colour = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const VkAttachmentReference depth = {1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
  const VkAttachmentReference result = {2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass = {};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &colour;
  subpass.pDepthStencilAttachment = &depth;
  if (resolves()) {
    subpass.pResolveAttachments = &result;
  }
  const std::array<VkSubpassDependency, 2> dependencies = {before_drawing(),
                                                           before_reading(!spec_.outer.empty())};
  VkRenderPassCreateInfo info = {};
  info.attachmentCount = resolves() ? 3 : 2;
  info.pAttachments = described.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = static_cast<std::uint32_t>(dependencies.size());
  info.pDependencies = dependencies.data();
  set_pass(device, info, part);
}

void Targets::make_depth_pass(const Device& device) {
  VkAttachmentDescription described =
      attachment(spec_.depth, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR,
                 VK_ATTACHMENT_STORE_OP_STORE, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
  const VkAttachmentReference depth = {0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass = {};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.pDepthStencilAttachment = &depth;
  VkSubpassDependency after = before_reading(true);
  after.srcStageMask = VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
  after.srcAccessMask = VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  const std::array<VkSubpassDependency, 2> dependencies = {before_drawing(), after};
  VkRenderPassCreateInfo info = {};
  info.attachmentCount = 1;
  info.pAttachments = &described;
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = static_cast<std::uint32_t>(dependencies.size());
  info.pDependencies = dependencies.data();
  set_pass(device, info);
}

void Targets::copy_result(VkCommandBuffer commands, std::size_t outer) const {
  constexpr VkPipelineStageFlags kOthers = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                           VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT |
                                           VK_PIPELINE_STAGE_TRANSFER_BIT;
  VkImageMemoryBarrier change = {};
  change.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
  change.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  change.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  change.srcQueueFamilyIndex = change.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  change.image = drawn(outer);
  change.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, first_layer(outer), spec_.views};
  vkCmdPipelineBarrier(commands, kOthers, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr,
                       1, &change);
  VkImageCopy whole = {};
  whole.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, spec_.views};
  whole.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, first_layer(outer), spec_.views};
  whole.extent = {spec_.width, spec_.height, 1};
  vkCmdCopyImage(commands, result_.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, drawn(outer),
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &whole);
  change.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  change.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  change.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  change.newLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, kOthers, 0, 0, nullptr, 0, nullptr,
                       1, &change);
}

/// All views at once.
void Targets::set_pass(const Device& device, VkRenderPassCreateInfo info, PassPart part) {
  const std::uint32_t view_mask = (1u << spec_.views) - 1;
  const VkRenderPassMultiviewCreateInfo multiview = all_at_once(view_mask);
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  info.pNext = &multiview;
  VkRenderPass pass = VK_NULL_HANDLE;
  check(vkCreateRenderPass(device.get(), &info, nullptr, &pass), "render pass");
  passes_[static_cast<std::size_t>(part)] = RenderPass(device.get(), pass);
}

}  // namespace orthonav::render
