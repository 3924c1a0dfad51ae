#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/holograms/labels/panel_layout.h"
#include "hal/api/pixel_display.h"
#include "render/renderer.h"

namespace orthonav::engine {

/// The status line on the display's own panel, if it has one. The panel is drawn only when its
/// contents change. It shows everything in a scene that hangs on the head, or nothing: if it fails,
/// the eyes' images show all of that, as they do without a panel.
class StatusPanel {
 public:
  /// `offered`: whether the display has images for it. `display` and `renderer` must outlive it.
  StatusPanel(PixelDisplay& display, render::Renderer& renderer, bool offered)
      : display_(display), renderer_(renderer), offered_(offered) {}

  /// Makes the panel show what hangs on the head in this frame's scene. False: the eyes' images
  /// must show it. Costs almost nothing if the panel shows it already.
  bool show(const render::Scene& scene);
  /// The panel to submit with this frame; absent if it is not to be shown.
  [[nodiscard]] const std::optional<HeadPanel>& shown() const { return shown_; }
  /// The frame was ended, without an error if `well`; `show` of the next one follows.
  void ended(bool well);

  [[nodiscard]] std::int64_t drawn() const { return drawn_count_; }
  /// The newest reason why the panel did not show what it should; empty: none.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  Status draw();

  PixelDisplay& display_;
  render::Renderer& renderer_;
  bool offered_;
  PanelLayout layout_;
  const render::View view_ = status_panel_view();
  render::Scene drawn_;             ///< what its newest image shows
  render::Scene next_;              ///< what it is to show
  bool holds_ = false;              ///< there is an image of `drawn_`
  std::optional<HeadPanel> shown_;  ///< in this frame
  std::int64_t drawn_count_ = 0;
  std::string problem_;
};

}  // namespace orthonav::engine
