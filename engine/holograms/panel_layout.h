#pragma once

#include <array>
#include <vector>

#include "hal/api/pixel_display.h"
#include "render/scene.h"
#include "render/text/font.h"
#include "render/text/text_layout.h"

namespace orthonav::engine {

// H11 on a panel that the display itself lays over the eyes' images: at the same place and as large
// as in these. All rows of the status line, and the notices above it, fit on it.

/// Width and height of the panel's images: 32 pixels a degree, what the headsets that are known
/// resolve at most.
inline constexpr std::array<int, 2> kStatusPanel_px = {1152, 176};
[[nodiscard]] HeadPanel status_panel();
/// An eye that sees just the panel; its axes are those of the scenes that `write` makes.
[[nodiscard]] render::View status_panel_view();

class PanelLayout {
 public:
  /// The texts of `scene` that hang on the head, as `status_panel_view` is to see them. False where
  /// one of them hangs elsewhere than the status line.
  [[nodiscard]] static bool write(const render::Scene& scene, render::Scene& panel);
  /// Whether all of a written panel fits on it.
  [[nodiscard]] bool fits(const render::Scene& panel);

 private:
  render::Font font_;
  std::vector<render::PlacedGlyph> glyphs_;
};

}  // namespace orthonav::engine
