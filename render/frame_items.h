#pragma once

#include <cstdint>
#include <vector>

#include "render/projection.h"
#include "render/scene.h"
#include "render/text/font.h"
#include "render/text/text_layout.h"

namespace orthonav::render {

/// Four floats, as the shaders read them.
struct Float4 {
  float x = 0;
  float y = 0;
  float z = 0;
  float w = 0;
};

/// A line as pairs of points (dashes are cut already) or a triangle as three corners, in the data.
struct SpanDraw {
  Label label = 0;
  Colour colour;
  float width_m = 0;
  std::uint32_t first = 0;  ///< in FrameItems::data
  std::uint32_t count = 0;  ///< segments of a line; corners of a triangle
};

/// A line of text: glyphs as three Float4 each (rectangle in cap heights, texture, ink).
struct TextDraw {
  Label label = 0;
  Matrix4 world_from_caps{};
  Colour rim;
  std::uint32_t first = 0;
  std::uint32_t count = 0;  ///< glyphs
};

/// A scene made ready for the shaders, in drawing order. Reused between frames: build() allocates
/// only when a frame is larger than all before it.
class FrameItems {
 public:
  void build(const Scene& scene, const std::vector<View>& views, const Font& font);

  [[nodiscard]] const std::vector<const MeshItem*>& veils() const { return veils_; }
  [[nodiscard]] const std::vector<const MeshItem*>& solids() const { return solids_; }
  [[nodiscard]] const std::vector<SpanDraw>& triangles() const { return triangles_; }
  [[nodiscard]] const std::vector<SpanDraw>& lines() const { return lines_; }
  [[nodiscard]] const std::vector<TextDraw>& texts() const { return texts_; }
  [[nodiscard]] const std::vector<Float4>& data() const { return data_; }
  /// Segments of the longest line.
  [[nodiscard]] std::uint32_t most_segments() const { return most_segments_; }

 private:
  void add_line(const LineItem& item);
  void add_segment(Float3 a, Float3 b);
  void add_dashes(const LineItem& item);
  void add_text(const TextItem& item, const Head& head, const Font& font);

  std::vector<const MeshItem*> veils_;
  std::vector<const MeshItem*> solids_;
  std::vector<SpanDraw> triangles_;
  std::vector<SpanDraw> lines_;
  std::vector<TextDraw> texts_;
  std::vector<Float4> data_;
  std::vector<PlacedGlyph> glyphs_;
  std::vector<std::uint32_t> order_;
  std::uint32_t most_segments_ = 0;
};

/// A mesh that hides what is behind it; every other mesh is a veil: only its nearest surface shows,
/// and lines, triangles and text shine through it.
[[nodiscard]] inline bool is_opaque(const MeshItem& item) {
  return item.style == MeshStyle::kSolid && item.colour.a >= 1;
}

/// Where a line of text stands: columns right and up, one cap height long each, and its anchor.
[[nodiscard]] Matrix4 world_from_caps(const TextItem& item, const Head& head);

}  // namespace orthonav::render
