#include "engine/holograms/labels/panel_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/holograms/shapes/hologram_status.h"
#include "render/float3.h"

namespace orthonav::engine {
namespace {

/// Pixels per cap height of the status line.
constexpr float kCap_px = 16.0f;

float distance_m() { return render::length(kStatusPlace); }

/// The cap height of a text that hangs where the status line does.
float cap_m(const render::TextItem& text) {
  const float least_rad = text.min_height_deg * std::numbers::pi_v<float> / 180.0f;
  return std::max(text.height_m, 2.0f * std::tan(0.5f * least_rad) * distance_m());
}

/// The cap height of the status line.
float status_cap_m() {
  render::TextItem text;
  text.height_m = kStatusHeight_m;
  text.min_height_deg = kStatusMinHeight_deg;
  return cap_m(text);
}

/// Half the width and half the height of the panel.
std::array<float, 2> half_size_m() {
  const float pixel_m = status_cap_m() / kCap_px;
  return {0.5f * static_cast<float>(kStatusPanel_px[0]) * pixel_m,
          0.5f * static_cast<float>(kStatusPanel_px[1]) * pixel_m};
}

}  // namespace

HeadPanel status_panel(render::Float3 place) {
  const auto [across_m, up_m] = half_size_m();
  HeadPanel panel;
  panel.middle_m = {static_cast<double>(place.x), static_cast<double>(place.y),
                    static_cast<double>(place.z)};
  panel.width_m = 2.0 * static_cast<double>(across_m);
  panel.height_m = 2.0 * static_cast<double>(up_m);
  return panel;
}

render::View status_panel_view() {
  const auto [across_m, up_m] = half_size_m();
  render::View view;
  view.tan_left = view.tan_right = across_m / distance_m();
  view.tan_up = view.tan_down = up_m / distance_m();
  return view;
}

std::optional<render::Float3> PanelLayout::write(const render::Scene& scene, render::Scene& panel) {
  constexpr float kRounding_m = 1e-4f;
  panel.clear();
  render::Float3 place = kStatusPlace;
  for (const render::TextItem& text : scene.texts) {
    if (text.place != render::TextPlace::kView) {
      continue;
    }
    place = panel.texts.empty() ? text.position : place;
    if (text.position != place || std::abs(render::length(place) - distance_m()) > kRounding_m) {
      return std::nullopt;
    }
    render::TextItem& on_panel = panel.texts.emplace_back();
    on_panel = text;
    on_panel.position = {0, 0, -distance_m()};
  }
  return place;
}

bool PanelLayout::fits(const render::Scene& panel) {
  const auto [across_m, up_m] = half_size_m();
  for (const render::TextItem& text : panel.texts) {
    const float caps_across = across_m / cap_m(text);
    const float caps_up = up_m / cap_m(text);
    glyphs_.clear();
    lay_out(font_, text, glyphs_);
    const bool inside =
        std::all_of(glyphs_.begin(), glyphs_.end(), [&](const render::PlacedGlyph& glyph) {
          return glyph.left >= -caps_across && glyph.right <= caps_across &&
                 glyph.bottom >= -caps_up && glyph.top <= caps_up;
        });
    if (!inside) {
      return false;
    }
  }
  return true;
}

}  // namespace orthonav::engine
