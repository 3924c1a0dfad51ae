#pragma once

#include "base/vulkan_handover.h"
#include "hal/api/pixel_display.h"
#include "hal/openxr/chain.h"
#include "hal/openxr/view_setup.h"

namespace orthonav::openxr {

/// The images of a panel that hangs on the head, a layer of its own beside that of the eyes
/// (XrCompositionLayerQuad). A session does without where the runtime takes one layer only or makes
/// no such images, and from the first frame on that the runtime refuses with the panel in it.
class PanelChain {
 public:
  PanelChain() = default;
  ~PanelChain() { destroy(); }
  PanelChain(const PanelChain&) = delete;
  PanelChain& operator=(const PanelChain&) = delete;

  /// In the eyes' format. The images that it got; none where it is done without.
  PanelImages create(XrSession session, const ViewSetup& setup, std::int64_t format,
                     std::array<int, 2> size_px);
  void destroy();

  /// Does not wait. An Error when no image is free, or the panel was given up.
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
