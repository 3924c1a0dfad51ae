#include "hal/openxr/chain.h"

#include "hal/openxr/xr_error.h"

namespace orthonav::openxr {

XrSwapchainCreateInfo Chain::plain(XrSwapchainUsageFlags usage, std::int64_t format, int width_px,
                                   int height_px) {
  XrSwapchainCreateInfo info = {XR_TYPE_SWAPCHAIN_CREATE_INFO};
  info.usageFlags = XR_SWAPCHAIN_USAGE_SAMPLED_BIT | usage;
  info.format = format;
  info.sampleCount = 1;
  info.width = static_cast<std::uint32_t>(width_px);
  info.height = static_cast<std::uint32_t>(height_px);
  info.faceCount = 1;
  info.arraySize = 1;
  info.mipCount = 1;
  return info;
}

Status Chain::create(XrSession session, const XrSwapchainCreateInfo& info,
                     std::vector<std::uint64_t>& images) {
  const XrResult created = xrCreateSwapchain(session, &info, &handle_);
  if (XR_FAILED(created)) {
    handle_ = XR_NULL_HANDLE;
    return error_of("create a swapchain", created);
  }
  std::uint32_t count = 0;
  XrResult told = xrEnumerateSwapchainImages(handle_, 0, &count, nullptr);
  std::vector<XrSwapchainImageVulkan2KHR> made(count, {XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR});
  if (XR_SUCCEEDED(told)) {
    told = xrEnumerateSwapchainImages(handle_, count, &count,
                                      reinterpret_cast<XrSwapchainImageBaseHeader*>(made.data()));
  }
  if (XR_FAILED(told)) {
    return error_of("ask for the images of a swapchain", told);
  }
  images.clear();
  for (const XrSwapchainImageVulkan2KHR& image : made) {
    images.push_back(reinterpret_cast<std::uint64_t>(image.image));
  }
  return {};
}

void Chain::destroy() {
  if (handle_ != XR_NULL_HANDLE) {
    xrDestroySwapchain(handle_);
  }
  *this = {};
}

XrResult Chain::acquire(XrDuration patience) {
  if (waited_) {
    return XR_SUCCESS;
  }
  if (!acquired_) {
    const XrSwapchainImageAcquireInfo info = {XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO};
    const XrResult acquired = xrAcquireSwapchainImage(handle_, &info, &index_);
    if (XR_FAILED(acquired)) {
      return acquired;
    }
    acquired_ = true;
  }
  XrSwapchainImageWaitInfo info = {XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO};
  info.timeout = patience;
  const XrResult waited = xrWaitSwapchainImage(handle_, &info);
  waited_ = waited == XR_SUCCESS || waited == XR_SESSION_LOSS_PENDING;
  return waited;
}

XrResult Chain::release() {
  if (!waited_) {
    return XR_SUCCESS;
  }
  acquired_ = waited_ = false;
  const XrSwapchainImageReleaseInfo info = {XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO};
  return xrReleaseSwapchainImage(handle_, &info);
}

}  // namespace orthonav::openxr
