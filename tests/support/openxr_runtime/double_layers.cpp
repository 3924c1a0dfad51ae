#include <cmath>
#include <cstring>

#include "tests/support/openxr_runtime/double_state.h"

// The layers of a frame, checked as a strict runtime would check them.

namespace orthonav::test {
namespace {

/// Why a part of an image can't be shown; empty when it can.
std::string flaw_of(Double& d, const XrSwapchainSubImage& part) {
  const DoubleSwapchain* chain = chain_of(d, part.swapchain);
  if (chain == nullptr) {
    return "a view of no swapchain";
  }
  if (!chain->released) {
    return "a view of an image that was never released";
  }
  const XrRect2Di& rect = part.imageRect;
  if (rect.offset.x < 0 || rect.offset.y < 0 || rect.extent.width <= 0 || rect.extent.height <= 0 ||
      rect.offset.x + rect.extent.width > static_cast<int>(chain->info.width) ||
      rect.offset.y + rect.extent.height > static_cast<int>(chain->info.height)) {
    return "a view outside its image";
  }
  if (part.imageArrayIndex >= chain->info.arraySize) {
    return "a view of a layer too many";
  }
  return {};
}

std::string flaw_of(Double& d, const XrCompositionLayerProjectionView& view) {
  if (std::string flaw = flaw_of(d, view.subImage); !flaw.empty()) {
    return flaw;
  }
  const XrQuaternionf& q = view.pose.orientation;
  if (std::fabs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) > 0.01f) {
    return "a view with a pose that is none";
  }
  if (!(view.fov.angleLeft < view.fov.angleRight && view.fov.angleDown < view.fov.angleUp)) {
    return "a view of nothing";
  }
  return {};
}

/// Reads the depth that is chained to a view, if any. Returns what is wrong with it, or nothing.
std::string take_depth(Double& d, const XrCompositionLayerProjectionView& view,
                       std::vector<float>& metres) {
  const auto* depth = static_cast<const XrCompositionLayerDepthInfoKHR*>(view.next);
  if (depth == nullptr) {
    return {};
  }
  if (!d.traits.takes_depth || depth->type != XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR) {
    return "a view with what was not switched on";
  }
  if (std::string flaw = flaw_of(d, depth->subImage); !flaw.empty()) {
    return flaw;
  }
  if (!(depth->minDepth >= 0 && depth->minDepth < depth->maxDepth && depth->maxDepth <= 1 &&
        depth->nearZ > 0 && depth->nearZ < depth->farZ)) {
    return "a depth of no range";
  }
  DoubleSwapchain& chain = *chain_of(d, depth->subImage.swapchain);
  if (chain.info.format != VK_FORMAT_D32_SFLOAT) {
    return "a depth that is none";
  }
  const auto bytes = chain.chain->read(*chain.released, depth->subImage.imageArrayIndex);
  metres.resize(bytes.size() / sizeof(float));
  std::memcpy(metres.data(), bytes.data(), bytes.size());
  // Inverts the hyperbola of a projection, for any far plane, also at infinity.
  for (float& value : metres) {
    value = 1.0f / (1.0f / depth->nearZ + value * (1.0f / depth->farZ - 1.0f / depth->nearZ));
  }
  return {};
}

XrResult take_eyes(Double& d, const XrCompositionLayerProjection& layer, SubmittedFrame& frame) {
  if (layer.viewCount != 2 || layer.next != nullptr) {
    return d.violated("a layer of other views than the two", XR_ERROR_LAYER_INVALID);
  }
  auto* space = reinterpret_cast<DoubleSpace*>(layer.space);
  if (d.session->spaces.count(space) == 0) {
    return d.violated("a layer in no space", XR_ERROR_HANDLE_INVALID);
  }
  frame.has_eyes = true;
  frame.on_head = space->type == XR_REFERENCE_SPACE_TYPE_VIEW;
  frame.flags = layer.layerFlags;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const XrCompositionLayerProjectionView& view = layer.views[eye];
    if (const std::string flaw = flaw_of(d, view); !flaw.empty()) {
      return d.violated(flaw, XR_ERROR_SWAPCHAIN_RECT_INVALID);
    }
    DoubleSwapchain& chain = *chain_of(d, view.subImage.swapchain);
    frame.poses[eye] = view.pose;
    frame.fovs[eye] = view.fov;
    frame.format = chain.info.format;
    if (d.traits.frames_kept > 0) {
      frame.pixels[eye] = chain.chain->read(*chain.released, view.subImage.imageArrayIndex);
    }
    if (const std::string flaw = take_depth(d, view, frame.depth_m[eye]); !flaw.empty()) {
      return d.violated(flaw, XR_ERROR_VALIDATION_FAILURE);
    }
  }
  return XR_SUCCESS;
}

std::string flaw_of(Double& d, const XrCompositionLayerQuad& quad) {
  if (std::string flaw = flaw_of(d, quad.subImage); !flaw.empty()) {
    return flaw;
  }
  const XrQuaternionf& q = quad.pose.orientation;
  if (std::fabs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) > 0.01f) {
    return "a quad with a pose that is none";
  }
  if (!(quad.size.width > 0 && quad.size.height > 0)) {
    return "a quad of no size";
  }
  if (quad.eyeVisibility != XR_EYE_VISIBILITY_BOTH || quad.next != nullptr) {
    return "a quad that this runtime does not know";
  }
  constexpr XrCompositionLayerFlags kKnown = XR_COMPOSITION_LAYER_CORRECT_CHROMATIC_ABERRATION_BIT |
                                             XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT |
                                             XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT;
  return (quad.layerFlags & ~kKnown) != 0 ? "a quad with flags that there are none of" : "";
}

XrResult take_quad(Double& d, const XrCompositionLayerQuad& layer, SubmittedFrame& frame) {
  auto* space = reinterpret_cast<DoubleSpace*>(layer.space);
  if (d.session->spaces.count(space) == 0) {
    return d.violated("a quad in no space", XR_ERROR_HANDLE_INVALID);
  }
  if (const std::string flaw = flaw_of(d, layer); !flaw.empty()) {
    return d.violated(flaw, XR_ERROR_SWAPCHAIN_RECT_INVALID);
  }
  if (frame.quad) {
    return d.violated("more quads than this runtime keeps", XR_ERROR_LAYER_INVALID);
  }
  DoubleSwapchain& chain = *chain_of(d, layer.subImage.swapchain);
  if (d.traits.frames_kept > 0 && chain.read_of != chain.releases) {
    chain.pixels = std::make_shared<const std::vector<std::uint8_t>>(
        chain.chain->read(*chain.released, layer.subImage.imageArrayIndex));
    chain.read_of = chain.releases;
  }
  frame.quad = SubmittedQuad{space->type == XR_REFERENCE_SPACE_TYPE_VIEW,
                             layer.pose,
                             layer.size,
                             layer.layerFlags,
                             chain.info.format,
                             static_cast<int>(chain.info.width),
                             static_cast<int>(chain.info.height),
                             chain.releases,
                             chain.pixels};
  return XR_SUCCESS;
}

}  // namespace

XrResult take_layers(Double& d, const XrFrameEndInfo& info, SubmittedFrame& frame) {
  if (info.layerCount > d.traits.most_composition_layers) {
    return d.violated("more layers than there may be", XR_ERROR_LAYER_LIMIT_EXCEEDED);
  }
  if (info.layerCount > 0 && info.layers == nullptr) {
    return d.violated("layers that are not there", XR_ERROR_VALIDATION_FAILURE);
  }
  for (std::uint32_t i = 0; i < info.layerCount; ++i) {
    const XrCompositionLayerBaseHeader* layer = info.layers[i];
    if (layer == nullptr) {
      return d.violated("a layer that is not there", XR_ERROR_LAYER_INVALID);
    }
    XrResult taken = XR_SUCCESS;
    if (layer->type == XR_TYPE_COMPOSITION_LAYER_PROJECTION && !frame.has_eyes) {
      taken = take_eyes(d, *reinterpret_cast<const XrCompositionLayerProjection*>(layer), frame);
    } else if (layer->type == XR_TYPE_COMPOSITION_LAYER_QUAD) {
      taken = take_quad(d, *reinterpret_cast<const XrCompositionLayerQuad*>(layer), frame);
    } else {
      taken = d.violated("a layer that this runtime does not know", XR_ERROR_LAYER_INVALID);
    }
    if (taken != XR_SUCCESS) {
      return taken;
    }
  }
  return XR_SUCCESS;
}

}  // namespace orthonav::test
