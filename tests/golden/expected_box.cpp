#include "tests/golden/expected_box.h"

#include <algorithm>
#include <optional>

#include "render/frame/frame_items.h"
#include "render/projection.h"
#include "tests/golden/golden_scene_edit.h"

namespace orthonav::engine {
namespace {

using render::Float3;

constexpr double kLeastRadius_px = 0.75;

/// A box that grows by points of the world as one view sees them.
class DrawnBox {
 public:
  DrawnBox(const GoldenScene& golden, std::size_t view)
      : golden_(golden), view_(golden.views.at(view)) {}

  void add(Float3 in_world, float width_m, double least_radius_px) {
    const auto at = render::project(view_, in_world, golden_.width_px, golden_.height_px);
    if (!at) {
      return;
    }
    const double pixels_at_1m =
        static_cast<double>(golden_.height_px) / static_cast<double>(view_.tan_up + view_.tan_down);
    const double radius_px = std::max(
        0.5 * static_cast<double>(width_m) * pixels_at_1m / static_cast<double>(at->depth_m),
        least_radius_px);
    box_.left = std::min(box_.left, at->x_px - radius_px);
    box_.right = std::max(box_.right, at->x_px + radius_px);
    box_.top = std::min(box_.top, at->y_px - radius_px);
    box_.bottom = std::max(box_.bottom, at->y_px + radius_px);
  }
  void add_point(Float3 in_world) { add(in_world, 0, 0); }
  [[nodiscard]] const Box& box() const { return box_; }

 private:
  const GoldenScene& golden_;
  const render::View& view_;
  Box box_;
};

}  // namespace

Box box_of_shapes(const GoldenScene& golden, render::Label label, std::size_t view) {
  const GoldenScene alone = only(golden, label, false);
  DrawnBox seen(golden, view);
  for (const render::MeshItem& item : alone.scene.meshes) {
    for (const Float3 p : item.mesh->positions) {
      seen.add_point(render::transformed(item.world_from_model, p));
    }
  }
  for (const render::TriangleItem& item : alone.scene.triangles) {
    for (const Float3 p : item.corners) {
      seen.add_point(p);
    }
  }
  // Dashes are cut as the renderer cuts them: the last one of a line rarely ends where the line
  // does.
  const render::Font font;
  render::FrameItems items;
  items.build(alone.scene, golden.views, font,
              [](const render::MeshItem& item) { return render::box_of(*item.mesh); });
  for (const render::SpanDraw& line : items.lines()) {
    for (std::uint32_t i = 0; i < 2 * line.count; ++i) {
      const render::Float4& p = items.data()[line.first + i];
      seen.add({p.x, p.y, p.z}, line.width_m, kLeastRadius_px);
    }
  }
  return seen.box();
}

Box box_of_text(const GoldenScene& golden, const render::TextItem& item, std::size_t view) {
  static const render::Font font;
  const render::Matrix4 place = world_from_caps(item, render::head_of(golden.views));
  std::vector<render::PlacedGlyph> glyphs;
  lay_out(font, item, glyphs);
  DrawnBox seen(golden, view);
  for (const render::PlacedGlyph& glyph : glyphs) {
    const float reach = font.header().reach - (item.rim.a > 0 ? render::kRimWidth : 0);
    for (const float x : {glyph.left + reach, glyph.right - reach}) {
      for (const float y : {glyph.bottom + reach, glyph.top - reach}) {
        seen.add_point(render::transformed(place, {x, y, 0}));
      }
    }
  }
  return seen.box();
}

}  // namespace orthonav::engine
