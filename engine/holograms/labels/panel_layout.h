#pragma once

#include <array>
#include <optional>
#include <vector>

#include "hal/api/pixel_display.h"
#include "render/scene.h"
#include "render/text/font.h"
#include "render/text/text_layout.h"

namespace orthonav::engine {

// H11 on a panel that the display itself lays over the eyes' images, with the same place and size
// as in those images: it goes with the status line where that makes way. All rows of the status
// line, and the notices above it, fit on it.

/// Width and height of the panel's images: 32 pixels a degree, the most that known headsets
/// resolve.
inline constexpr std::array<int, 2> kStatusPanel_px = {1152, 176};
/// The panel around a status line whose first row hangs there, on the head.
[[nodiscard]] HeadPanel status_panel(render::Float3 place);
/// The view of an eye that sees exactly the panel, in the axes of the scenes that `write` makes.
[[nodiscard]] render::View status_panel_view();

class PanelLayout {
 public:
  /// Writes into `panel` the texts of `scene` that hang on the head, placed for
  /// `status_panel_view`. Returns where they hang; absent if that is not one place as far from the
  /// eyes as the status line is built.
  [[nodiscard]] static std::optional<render::Float3> write(const render::Scene& scene,
                                                           render::Scene& panel);
  /// Whether all of a written panel fits on it.
  [[nodiscard]] bool fits(const render::Scene& panel);

 private:
  render::Font font_;
  std::vector<render::PlacedGlyph> glyphs_;
};

}  // namespace orthonav::engine
