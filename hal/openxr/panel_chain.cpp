#include "hal/openxr/panel_chain.h"

#include <cmath>

#include "hal/openxr/xr_error.h"

namespace orthonav::openxr {
namespace {

/// The rotation from a panel's axes (x right, y up, z towards the head) to the head's. The panel
/// stays upright, so this is a turn about y, then one about its own x.
XrQuaternionf facing_head(const Vec3& middle_m) {
  const double yaw_rad = std::atan2(-middle_m.x, -middle_m.z);
  const double pitch_rad = std::atan2(middle_m.y, std::hypot(middle_m.x, middle_m.z));
  const double sy = std::sin(0.5 * yaw_rad);
  const double cy = std::cos(0.5 * yaw_rad);
  const double sp = std::sin(0.5 * pitch_rad);
  const double cp = std::cos(0.5 * pitch_rad);
  return {static_cast<float>(cy * sp), static_cast<float>(sy * cp), static_cast<float>(-sy * sp),
          static_cast<float>(cy * cp)};
}

}  // namespace

PanelImages PanelChain::create(XrSession session, const ViewSetup& setup, std::int64_t format,
                               std::array<int, 2> size_px) {
  PanelImages images;
  const bool fits = size_px[0] <= setup.most_px[0] && size_px[1] <= setup.most_px[1];
  if (setup.most_layers < 2 || !fits) {
    return images;
  }
  const XrSwapchainCreateInfo info =
      Chain::plain(XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT, format, size_px[0], size_px[1]);
  if (!chain_.create(session, info, images.chain)) {
    destroy();
    return {};
  }
  size_px_ = size_px;
  images.width_px = size_px[0];
  images.height_px = size_px[1];
  given_up_ = false;
  return images;
}

void PanelChain::destroy() {
  chain_.destroy();
  released_ = false;
  given_up_ = true;
}

Result<std::uint32_t> PanelChain::acquire() {
  if (given_up_) {
    return Error{"openxr: the runtime takes no panel"};
  }
  const XrResult acquired = chain_.acquire(XR_NO_DURATION);
  if (!chain_.ready()) {
    return error_of("acquire an image of the panel", acquired);
  }
  return chain_.index();
}

Status PanelChain::release() {
  const XrResult released = chain_.release();
  if (XR_FAILED(released)) {
    given_up_ = true;
    return error_of("release an image of the panel", released);
  }
  released_ = true;
  return {};
}

XrCompositionLayerQuad PanelChain::layer(const HeadPanel& panel, XrSpace viewer) const {
  XrCompositionLayerQuad quad = {XR_TYPE_COMPOSITION_LAYER_QUAD};
  // The images are premultiplied; where nothing is drawn, the layer below shows.
  quad.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
  quad.space = viewer;
  quad.eyeVisibility = XR_EYE_VISIBILITY_BOTH;
  quad.subImage.swapchain = chain_.handle();
  quad.subImage.imageRect.extent = {size_px_[0], size_px_[1]};
  quad.pose.orientation = facing_head(panel.middle_m);
  quad.pose.position = {static_cast<float>(panel.middle_m.x), static_cast<float>(panel.middle_m.y),
                        static_cast<float>(panel.middle_m.z)};
  quad.size = {static_cast<float>(panel.width_m), static_cast<float>(panel.height_m)};
  return quad;
}

}  // namespace orthonav::openxr
