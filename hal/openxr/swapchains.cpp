#include "hal/openxr/swapchains.h"

#include "hal/openxr/xr_error.h"

namespace orthonav::openxr {
namespace {

/// A runtime that holds an image longer than this has stalled; the frame goes without pixels.
constexpr XrDuration kPatience_ns = 200'000'000;

Result<std::vector<std::int64_t>> formats_of(XrSession session) {
  std::uint32_t count = 0;
  XrResult told = xrEnumerateSwapchainFormats(session, 0, &count, nullptr);
  std::vector<std::int64_t> formats(count);
  if (XR_SUCCEEDED(told)) {
    told = xrEnumerateSwapchainFormats(session, count, &count, formats.data());
  }
  if (XR_FAILED(told)) {
    return error_of("ask for the formats of its images", told);
  }
  return formats;
}

using Scores = int (FormatPreference::*)(std::int64_t) const;

/// The format with the highest score; among equals the one that the runtime prefers, which comes
/// first; 0 if none suits.
std::int64_t best_format(const std::vector<std::int64_t>& formats,
                         const FormatPreference& preference, Scores format_score) {
  std::int64_t best = 0;
  int most = 0;
  for (const std::int64_t format : formats) {
    if ((preference.*format_score)(format) <= most) {
      continue;
    }
    most = (preference.*format_score)(format);
    best = format;
  }
  return best;
}

Error no_format(const std::vector<std::int64_t>& formats) {
  std::string offered;
  for (const std::int64_t format : formats) {
    offered += " " + std::to_string(format);
  }
  return Error{"openxr: none of the image formats can be drawn into; offered:" + offered};
}

}  // namespace

Status Swapchains::create(XrSession session, const ViewSetup& setup,
                          const FormatPreference& preference, bool depth) {
  const auto formats = formats_of(session);
  if (!formats) {
    return formats.error();
  }
  const std::int64_t format = best_format(*formats, preference, &FormatPreference::format_score);
  if (format == 0) {
    return no_format(*formats);
  }
  images_ = {format, setup.width_px, setup.height_px, preference.takes_layers() ? 2u : 1u, {}, 0,
             {}};
  if (depth) {
    images_.depth_format = best_format(*formats, preference, &FormatPreference::depth_format_score);
  }
  if (images_.layers == 2) {
    if (add_chains(session, Content::kColour) && add_chains(session, Content::kDepth)) {
      return {};
    }
    // A runtime need not support layers: one swapchain per eye then.
    destroy();
    images_.layers = 1;
  }
  if (const Status added = add_chains(session, Content::kColour); !added) {
    return added;
  }
  return add_chains(session, Content::kDepth);
}

Status Swapchains::add_chains(XrSession session, Content content) {
  if (content == Content::kDepth && images_.depth_format == 0) {
    return {};
  }
  for (std::uint32_t chain = 0; chain < 2 / images_.layers; ++chain) {
    if (const Status added = add_chain(session, content); !added) {
      return added;
    }
  }
  return {};
}

Status Swapchains::add_chain(XrSession session, Content content) {
  const bool depth = content == Content::kDepth;
  XrSwapchainCreateInfo info = {XR_TYPE_SWAPCHAIN_CREATE_INFO};
  info.usageFlags =
      XR_SWAPCHAIN_USAGE_SAMPLED_BIT |
      (depth ? XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
             : XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_SRC_BIT);
  info.format = depth ? images_.depth_format : images_.format;
  info.sampleCount = 1;  // multisampled images are resolved into it
  info.width = static_cast<std::uint32_t>(images_.width_px);
  info.height = static_cast<std::uint32_t>(images_.height_px);
  info.faceCount = 1;
  info.arraySize = images_.layers;
  info.mipCount = 1;
  Chain chain;
  const XrResult created = xrCreateSwapchain(session, &info, &chain.handle);
  if (XR_FAILED(created)) {
    return error_of("create a swapchain", created);
  }
  chains_.push_back(chain);
  std::uint32_t count = 0;
  XrResult told = xrEnumerateSwapchainImages(chain.handle, 0, &count, nullptr);
  std::vector<XrSwapchainImageVulkan2KHR> images(count, {XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR});
  if (XR_SUCCEEDED(told)) {
    told = xrEnumerateSwapchainImages(chain.handle, count, &count,
                                      reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data()));
  }
  if (XR_FAILED(told)) {
    return error_of("ask for the images of a swapchain", told);
  }
  std::vector<std::uint64_t> handles;
  handles.reserve(images.size());
  for (const XrSwapchainImageVulkan2KHR& image : images) {
    handles.push_back(reinterpret_cast<std::uint64_t>(image.image));
  }
  (depth ? images_.depth_chains : images_.chains).push_back(std::move(handles));
  return {};
}

void Swapchains::destroy() {
  for (const Chain& chain : chains_) {
    xrDestroySwapchain(chain.handle);
  }
  chains_.clear();
  images_.chains.clear();
  images_.depth_chains.clear();
}

XrResult Swapchains::acquire(Chain& chain) {
  if (!chain.acquired) {
    const XrSwapchainImageAcquireInfo info = {XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO};
    const XrResult acquired = xrAcquireSwapchainImage(chain.handle, &info, &chain.index);
    if (XR_FAILED(acquired)) {
      return acquired;
    }
    chain.acquired = true;
  }
  XrSwapchainImageWaitInfo info = {XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO};
  info.timeout = kPatience_ns;
  const XrResult waited = xrWaitSwapchainImage(chain.handle, &info);
  if (waited == XR_SUCCESS || waited == XR_SESSION_LOSS_PENDING) {
    chain.waited = true;
  }
  return waited;
}

XrResult Swapchains::acquire(std::vector<std::uint32_t>& indices) {
  indices.clear();
  for (Chain& chain : chains_) {
    if (!chain.waited) {
      const XrResult acquired = acquire(chain);
      if (!chain.waited) {
        return acquired;
      }
    }
    indices.push_back(chain.index);
  }
  return XR_SUCCESS;
}

XrResult Swapchains::release() {
  XrResult first = XR_SUCCESS;
  for (Chain& chain : chains_) {
    if (!chain.waited) {
      continue;
    }
    chain.acquired = chain.waited = false;
    const XrSwapchainImageReleaseInfo info = {XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO};
    const XrResult released = xrReleaseSwapchainImage(chain.handle, &info);
    if (XR_FAILED(released) && first == XR_SUCCESS) {
      first = released;
    }
  }
  return first;
}

XrSwapchainSubImage Swapchains::part(std::size_t first_chain, std::size_t eye) const {
  const bool layered = images_.layers == 2;
  XrSwapchainSubImage part = {};
  part.swapchain = chains_[first_chain + (layered ? 0 : eye)].handle;
  part.imageRect.extent = {images_.width_px, images_.height_px};
  part.imageArrayIndex = layered ? static_cast<std::uint32_t>(eye) : 0;
  return part;
}

}  // namespace orthonav::openxr
