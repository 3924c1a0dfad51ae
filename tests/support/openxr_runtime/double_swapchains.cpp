#include <algorithm>
#include <memory>

#include "tests/support/openxr_runtime/double_state.h"

namespace orthonav::test {

DoubleSwapchain* chain_of(Double& d, XrSwapchain handle) {
  auto* chain = reinterpret_cast<DoubleSwapchain*>(handle);
  return d.session && d.session->swapchains.count(chain) > 0 ? chain : nullptr;
}

namespace {

XrResult XRAPI_CALL formats(XrSession, std::uint32_t capacity, std::uint32_t* count,
                            std::int64_t* values) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  return enumerate(d.traits.formats, capacity, count, values);
}

XrResult XRAPI_CALL create_swapchain(XrSession, const XrSwapchainCreateInfo* info,
                                     XrSwapchain* handle) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  const auto& offered = d.traits.formats;
  if (std::find(offered.begin(), offered.end(), info->format) == offered.end()) {
    return d.violated("a format that was not offered", XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED);
  }
  if (info->sampleCount != 1 || info->mipCount != 1 || info->faceCount != 1) {
    return d.violated("a swapchain of more than plain images", XR_ERROR_FEATURE_UNSUPPORTED);
  }
  if (info->width == 0 || info->width > 4096 || info->height == 0 || info->height > 4096) {
    return d.violated("a swapchain of no size", XR_ERROR_SWAPCHAIN_RECT_INVALID);
  }
  if (info->arraySize > d.traits.most_layers) {
    return XR_ERROR_FEATURE_UNSUPPORTED;
  }
  const bool panel = info->width != d.traits.width_px || info->height != d.traits.height_px;
  if (const XrResult failed = d.fails("xrCreateSwapchain", panel); failed != XR_SUCCESS) {
    return failed;
  }
  const bool depth = info->format == VK_FORMAT_D32_SFLOAT;
  const auto wanted = depth ? XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                            : XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT;
  if ((info->usageFlags & wanted) == 0) {
    return d.violated("images that can't be drawn into", XR_ERROR_FEATURE_UNSUPPORTED);
  }
  auto* chain = new DoubleSwapchain;
  chain->info = *info;
  chain->panel = panel;
  chain->chain = std::make_unique<ImageChain>(
      d.session->objects, static_cast<VkFormat>(info->format), static_cast<int>(info->width),
      static_cast<int>(info->height), info->arraySize, 3,
      depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT);
  d.session->swapchains.insert(chain);
  *handle = reinterpret_cast<XrSwapchain>(chain);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroy_swapchain(XrSwapchain handle) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  DoubleSwapchain* chain = chain_of(d, handle);
  if (chain == nullptr) {
    return d.violated("an unknown swapchain", XR_ERROR_HANDLE_INVALID);
  }
  d.session->swapchains.erase(chain);
  delete chain;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL images(XrSwapchain handle, std::uint32_t capacity, std::uint32_t* count,
                           XrSwapchainImageBaseHeader* values) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  DoubleSwapchain* chain = chain_of(d, handle);
  if (chain == nullptr) {
    return d.violated("an unknown swapchain", XR_ERROR_HANDLE_INVALID);
  }
  if (const XrResult failed = d.fails("xrEnumerateSwapchainImages", chain->panel);
      failed != XR_SUCCESS) {
    return failed;
  }
  const auto& all = chain->chain->images();
  *count = static_cast<std::uint32_t>(all.size());
  if (capacity == 0) {
    return XR_SUCCESS;
  }
  if (capacity < all.size()) {
    return XR_ERROR_SIZE_INSUFFICIENT;
  }
  auto* out = reinterpret_cast<XrSwapchainImageVulkan2KHR*>(values);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (out[i].type != XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR) {
      return d.violated("images of another kind", XR_ERROR_VALIDATION_FAILURE);
    }
    out[i].image = all[i];
  }
  return XR_SUCCESS;
}

/// What every call on an image of a chain begins with: its chain, or why there is none. With the
/// mutex held.
XrResult call_on_chain(Double& d, XrSwapchain handle, const char* name, DoubleSwapchain*& chain) {
  if (const XrResult dead = d.alive(); dead != XR_SUCCESS) {
    return dead;
  }
  chain = chain_of(d, handle);
  return chain == nullptr ? d.violated("an unknown swapchain", XR_ERROR_HANDLE_INVALID)
                          : d.fails(name, chain->panel);
}

XrResult XRAPI_CALL acquire(XrSwapchain handle, const XrSwapchainImageAcquireInfo*,
                            std::uint32_t* index) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  DoubleSwapchain* chain = nullptr;
  if (const XrResult failed = call_on_chain(d, handle, "xrAcquireSwapchainImage", chain);
      failed != XR_SUCCESS) {
    return failed;
  }
  if (chain->acquired.size() == chain->chain->images().size()) {
    return d.violated("more images than there are", XR_ERROR_CALL_ORDER_INVALID);
  }
  *index = chain->next;
  chain->acquired.push_back(chain->next);
  chain->next = (chain->next + 1) % static_cast<std::uint32_t>(chain->chain->images().size());
  return XR_SUCCESS;
}

XrResult XRAPI_CALL wait_image(XrSwapchain handle, const XrSwapchainImageWaitInfo*) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  DoubleSwapchain* chain = nullptr;
  if (const XrResult failed = call_on_chain(d, handle, "xrWaitSwapchainImage", chain);
      failed != XR_SUCCESS) {
    return failed;
  }
  if (chain->acquired.empty() || chain->waited) {
    return d.violated("an image waited for out of turn", XR_ERROR_CALL_ORDER_INVALID);
  }
  chain->waited = true;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL release(XrSwapchain handle, const XrSwapchainImageReleaseInfo*) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  DoubleSwapchain* chain = nullptr;
  if (const XrResult failed = call_on_chain(d, handle, "xrReleaseSwapchainImage", chain);
      failed != XR_SUCCESS) {
    return failed;
  }
  if (!chain->waited) {
    return d.violated("an image released that was not waited for", XR_ERROR_CALL_ORDER_INVALID);
  }
  chain->released = chain->acquired.front();
  chain->acquired.pop_front();
  chain->waited = false;
  ++chain->releases;
  return XR_SUCCESS;
}

}  // namespace

void add_swapchain_functions(std::map<std::string, PFN_xrVoidFunction>& table) {
  table["xrEnumerateSwapchainFormats"] = as_void(formats);
  table["xrCreateSwapchain"] = as_void(create_swapchain);
  table["xrDestroySwapchain"] = as_void(destroy_swapchain);
  table["xrEnumerateSwapchainImages"] = as_void(images);
  table["xrAcquireSwapchainImage"] = as_void(acquire);
  table["xrWaitSwapchainImage"] = as_void(wait_image);
  table["xrReleaseSwapchainImage"] = as_void(release);
}

}  // namespace orthonav::test
