#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/holograms/panel_layout.h"
#include "hal/api/pixel_display.h"
#include "render/hosted_renderer.h"

namespace orthonav::engine {

/// The status line on the display's own panel, where it has one. The panel is drawn only when it is
/// to say something else. It says all that hangs on the head in a scene, or nothing: where it
/// fails, the eyes' images show that as they do without a panel.
class StatusPanel {
 public:
  /// `offered`: whether the display gave images for it. Both must outlive it.
  StatusPanel(PixelDisplay& display, render::HostedRenderer& renderer, bool offered)
      : display_(display), renderer_(renderer), offered_(offered) {}

  /// Has the panel say what hangs on the head in this frame's scene. False: the eyes' images must
  /// show it. Costs next to nothing where the panel says so already.
  bool show(const render::Scene& scene);
  /// The panel of this frame; absent where it is not to be seen.
  [[nodiscard]] std::optional<HeadPanel> shown() const;
  /// The frame was ended, well or not; `show` of the next follows.
  void ended(bool well);

  [[nodiscard]] std::int64_t drawn() const { return drawn_count_; }
  /// The newest reason why the panel did not say what it should; empty: none.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  Status draw();

  PixelDisplay& display_;
  render::HostedRenderer& renderer_;
  bool offered_;
  PanelLayout layout_;
  const render::View view_ = status_panel_view();
  render::Scene drawn_;  ///< what its newest image says
  render::Scene next_;   ///< what it is to say
  bool holds_ = false;   ///< it has such an image
  bool shown_ = false;   ///< in this frame
  std::int64_t drawn_count_ = 0;
  std::string problem_;
};

}  // namespace orthonav::engine
