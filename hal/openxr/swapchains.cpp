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
  images_ = {format, setup.width_px, setup.height_px, 2, {}, 0, {}, {}};
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
  constexpr XrSwapchainUsageFlags kColour = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT |
                                            XR_SWAPCHAIN_USAGE_TRANSFER_SRC_BIT |
                                            XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT;
  XrSwapchainCreateInfo info = Chain::plain(
      depth ? XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : kColour,
      depth ? images_.depth_format : images_.format, images_.width_px, images_.height_px);
  info.arraySize = images_.layers;
  std::vector<std::uint64_t> images;
  const Status created = chains_.emplace_back().create(session, info, images);
  if (!created) {
    return created;
  }
  (depth ? images_.depth_chains : images_.chains).push_back(std::move(images));
  return {};
}

void Swapchains::destroy() {
  for (Chain& chain : chains_) {
    chain.destroy();
  }
  chains_.clear();
  images_.chains.clear();
  images_.depth_chains.clear();
}

XrResult Swapchains::acquire(std::vector<std::uint32_t>& indices) {
  indices.clear();
  for (Chain& chain : chains_) {
    const XrResult acquired = chain.acquire(kPatience_ns);
    if (!chain.ready()) {
      return acquired;
    }
    indices.push_back(chain.index());
  }
  return XR_SUCCESS;
}

XrResult Swapchains::release() {
  XrResult first = XR_SUCCESS;
  for (Chain& chain : chains_) {
    const XrResult released = chain.release();
    if (XR_FAILED(released) && first == XR_SUCCESS) {
      first = released;
    }
  }
  return first;
}

XrSwapchainSubImage Swapchains::part(std::size_t first_chain, std::size_t eye) const {
  const bool layered = images_.layers == 2;
  XrSwapchainSubImage part = {};
  part.swapchain = chains_[first_chain + (layered ? 0 : eye)].handle();
  part.imageRect.extent = {images_.width_px, images_.height_px};
  part.imageArrayIndex = layered ? static_cast<std::uint32_t>(eye) : 0;
  return part;
}

}  // namespace orthonav::openxr
