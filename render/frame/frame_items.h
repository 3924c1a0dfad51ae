#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/frame/screen_bounds.h"
#include "render/projection.h"
#include "render/scene.h"
#include "render/text/font.h"
#include "render/text/text_layout.h"

namespace orthonav::render {

struct MeshDraw {
  const MeshItem* item = nullptr;
  PixelRect bounds;       ///< set by FrameItems::place, as in all structs that follow
  std::size_t level = 0;  ///< how finely it is drawn, set by FrameItems::set_levels
};

/// A line as pairs of points (already cut into dashes), or a triangle as three corners, in the
/// data.
struct SpanDraw {
  Label label = 0;
  Colour colour;
  float width_m = 0;
  std::uint32_t first = 0;  ///< in FrameItems::data
  std::uint32_t count = 0;  ///< segments of a line; corners of a triangle
  PixelRect bounds{};
  std::uint32_t item = 0;  ///< the same for all spans of one line
  bool rounded = true;     ///< true: its segments end in discs; false: they continue one another
};

/// A line of text: glyphs as three Float4 each (rectangle in cap heights, texture, ink).
struct TextDraw {
  Label label = 0;
  Matrix4 world_from_caps = kIdentity;
  Colour rim;
  std::uint32_t first = 0;
  std::uint32_t count = 0;  ///< glyphs
  PixelRect bounds{};
};

/// The size of a pass's images.
struct PixelSize {
  int width_px = 0;
  int height_px = 0;
};

/// A scene prepared for the shaders, in drawing order. Reused between frames: it allocates only
/// when a frame is larger than all before it.
class FrameItems {
 public:
  /// `box_of` gives a mesh's bounding box. Points of lines are left out where that moves the line
  /// by less than `least_rad`.
  void build(const Scene& scene, const std::vector<View>& views, const Font& font,
             const BoxOf& box_of, float least_rad = 0, HeadTexts head_texts = HeadTexts::kDrawn);

  template <class LevelOf>
  void set_levels(const LevelOf& level_of) {
    for (auto* meshes : {&translucent_meshes_, &solids_}) {
      for (MeshDraw& draw : *meshes) {
        draw.level = level_of(*draw.item);
      }
    }
  }

  /// Finds where each item may appear in the views of one pass, and the regions that hold all
  /// items: no two regions share a pixel, and each item lies in one region.
  void place(std::span<const View> views, PixelSize size, const BoxOf& box_of);
  [[nodiscard]] const std::vector<PixelRect>& regions() const { return regions_; }

  [[nodiscard]] const std::vector<MeshDraw>& translucent_meshes() const {
    return translucent_meshes_;
  }
  [[nodiscard]] const std::vector<MeshDraw>& solids() const { return solids_; }
  [[nodiscard]] const std::vector<SpanDraw>& triangles() const { return triangles_; }
  [[nodiscard]] const std::vector<SpanDraw>& lines() const { return lines_; }
  [[nodiscard]] const std::vector<TextDraw>& texts() const { return texts_; }
  [[nodiscard]] const std::vector<Float4>& data() const { return data_; }
  /// Number of segments of the longest line.
  [[nodiscard]] std::uint32_t most_segments() const { return most_segments_; }

 private:
  void add_line(const LineItem& item, float least_rad);
  void add_segment(Float3 a, Float3 b);
  void add_many(const LineItem& item, float least_rad);
  void end_line(const LineItem& item, std::uint32_t first, bool rounded);
  void add_dashes(const LineItem& item);
  void add_texts(const Scene& scene, const Head& head, const Font& font, HeadTexts head_texts);
  void add_text(const TextItem& item, const Head& head, const Font& font);

  [[nodiscard]] PixelRect bounds_of(const SpanDraw& draw, std::uint32_t points,
                                    ScreenBounds& bounds) const;
  [[nodiscard]] PixelRect bounds_of(const TextDraw& draw, ScreenBounds& bounds) const;

  std::vector<MeshDraw> translucent_meshes_;
  std::vector<MeshDraw> solids_;
  std::vector<SpanDraw> triangles_;
  std::vector<SpanDraw> lines_;
  std::vector<TextDraw> texts_;
  std::vector<Float4> data_;
  std::vector<PlacedGlyph> glyphs_;
  std::vector<std::uint32_t> order_;
  std::vector<Float3> eyes_;
  std::vector<Float3> thinned_;
  std::vector<std::size_t> plain_;  ///< segments by their second point
  const LineItem* lines_of_scene_ = nullptr;
  std::vector<PixelRect> regions_;
  std::uint32_t most_segments_ = 0;
};

/// A mesh that hides what is behind it. Every other mesh is a veil: only its nearest surface shows,
/// and lines, triangles and text shine through it.
[[nodiscard]] inline bool is_opaque(const MeshItem& item) {
  return item.style == MeshStyle::kSolid && item.colour.a >= 1;
}

/// The placement of a line of text: its axes to the right and up, each one cap height long, and its
/// anchor.
[[nodiscard]] Matrix4 world_from_caps(const TextItem& item, const Head& head);

}  // namespace orthonav::render
