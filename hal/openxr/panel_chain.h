#pragma once

#include "base/vulkan_handover.h"
#include "hal/api/pixel_display.h"
#include "hal/openxr/chain.h"
#include "hal/openxr/view_setup.h"

namespace orthonav::openxr {

/// The images of a panel that hangs on the head, shown in a layer of its own over the eyes' layer
/// (XrCompositionLayerQuad). A session has no panel if the runtime takes only one layer or makes no
/// images for it. It is given up for the rest of the session once the runtime refuses a frame with
/// the panel in it or fails to take an image back.
class PanelChain {
 public:
  PanelChain() = default;
  ~PanelChain() { destroy(); }
  PanelChain(const PanelChain&) = delete;
  PanelChain& operator=(const PanelChain&) = delete;

  /// Returns the panel's images, in the eyes' format; none if there is no panel.
  PanelImages create(XrSession session, const ViewSetup& setup, std::int64_t format,
                     std::array<int, 2> size_px);
  void destroy();

  /// Does not wait. An Error if no image is free or the panel was given up.
  Result<std::uint32_t> acquire();
  Status release();
  void give_up() { given_up_ = true; }
  /// Whether an image was released, so that a layer may show it.
  [[nodiscard]] bool shows() const { return released_ && !given_up_; }
  /// The layer that shows the newest image on the head; `viewer` is the VIEW space.
  [[nodiscard]] XrCompositionLayerQuad layer(const HeadPanel& panel, XrSpace viewer) const;

 private:
  Chain chain_;
  std::array<int, 2> size_px_{};
  bool released_ = false;
  bool given_up_ = true;
};

}  // namespace orthonav::openxr
