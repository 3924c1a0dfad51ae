#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/item_list.h"

namespace orthonav::render {

/// World coordinates in metres, right-handed, +y up. The renderer knows nothing of surgery.
using Float3 = glm::vec3;
using Float4 = glm::vec4;
/// Columns, for column vectors, as GLSL reads it.
using Matrix4 = glm::mat4;
inline constexpr Matrix4 kIdentity{1.0f};

/// Linear (not sRGB-encoded) colour and opacity in [0, 1]; not premultiplied.
struct Colour {
  float r = 1;
  float g = 1;
  float b = 1;
  float a = 1;
  friend bool operator==(const Colour&, const Colour&) = default;
};

/// Which hologram an item belongs to; the value written into the label image. 0 is background.
/// By convention 100·n + k for the k-th instance of hologram Hn (H3 of screw 2: 302).
using Label = std::uint32_t;

/// Triangles that stand for those of a surface, between the same vertices.
struct MeshLevel {
  std::vector<std::uint32_t> indices;
  float error = 0;  ///< how far they are off, mean over triangles, in the mesh's own unit
};

/// A surface, shared between frames: the renderer identifies its GPU copy by the pointer. Its
/// inside is never drawn.
struct MeshData {
  std::vector<Float3> positions;
  std::vector<Float3> normals;         ///< one per vertex, unit length
  std::vector<std::uint32_t> indices;  ///< three per triangle, counter-clockwise from outside
  /// From 0 (the item's colour) to 1 (its tint): one per vertex, or none for the colour alone.
  std::vector<float> tints;
  /// Finest first, as `prepared` finds them; the farther away, the coarser the one that is drawn.
  /// None: `indices`, wherever it is.
  std::vector<MeshLevel> levels;
  /// For a tube: the path it was made along, and its radius; otherwise empty. Not drawn.
  std::vector<Float3> axis;
  float axis_radius_m = 0;
};

enum class MeshStyle {
  kSolid,  ///< lit by a headlight
  kRim     ///< bright where the surface turns away from the eye, thin where it faces it
};

struct MeshItem {
  Label label = 0;
  std::shared_ptr<const MeshData> mesh;
  Matrix4 world_from_model =
      kIdentity;  ///< rotation, translation and uniform scale; never a reflection
  Colour colour;
  Colour tint;  ///< where the mesh has tints; as opaque as `colour`
  MeshStyle style = MeshStyle::kSolid;
};
inline void renew(MeshItem& item) { item = {}; }

/// A line through world points, `width_m` wide as seen from the eye, never thinner than 1.5 px.
struct LineItem {
  Label label = 0;
  std::vector<Float3> points;
  float width_m = 0.001f;
  Colour colour;
  bool closed = false;
  float dash_m = 0;  ///< length of a dash and of the gap after it; 0 is solid
};
inline void renew(LineItem& item) {
  std::vector<Float3> points = std::move(item.points);
  points.clear();
  item = {};
  item.points = std::move(points);
}

/// A filled triangle, seen from both sides.
struct TriangleItem {
  Label label = 0;
  std::array<Float3, 3> corners{};
  Colour colour;
};
inline void renew(TriangleItem& item) { item = {}; }

struct TextRun {
  std::string text;  ///< UTF-8
  Colour colour;
  friend bool operator==(const TextRun&, const TextRun&) = default;
};
inline void renew(TextRun& run) {
  run.text.clear();
  run.colour = {};
}

enum class TextPlace {
  kWorld,  ///< at `position` in the world, facing the eyes, upright to the head
  kView    ///< at `position` in the head's frame (x right, y up, -z forward, metres): status line
};
/// Whether texts in the head's frame are drawn.
enum class HeadTexts {
  kDrawn,
  kLeftOut  ///< they are shown elsewhere
};
enum class TextAlign { kLeft, kCentre, kRight };

/// One line of text; digits are tabular. The cap height is `height_m`, but never less than
/// `min_height_deg` of visual angle.
struct TextItem {
  Label label = 0;
  ItemList<TextRun> runs;
  Float3 position{};
  TextPlace place = TextPlace::kWorld;
  TextAlign align = TextAlign::kCentre;
  float height_m = 0.006f;
  float min_height_deg = 0;
  Colour rim{0, 0, 0, 0};  ///< outline of the glyphs; a = 0: none
  /// Offset in units of the cap height: right and up as seen by the eyes.
  float offset_right = 0;
  float offset_up = 0;
  friend bool operator==(const TextItem&, const TextItem&) = default;
};
inline void renew(TextItem& item) {
  ItemList<TextRun> runs = std::move(item.runs);
  runs.clear();
  item = {};
  item.runs = std::move(runs);
}

/// Everything one frame shows. Plain values: equal scenes give equal images.
struct Scene {
  ItemList<MeshItem> meshes;
  ItemList<LineItem> lines;
  ItemList<TriangleItem> triangles;
  ItemList<TextItem> texts;

  /// Empties it; the memory of its items is kept for the next frame.
  void clear() {
    meshes.clear();
    lines.clear();
    triangles.clear();
    texts.clear();
  }
};

/// One eye: where it is and what it sees. Tangents of the half angles, all positive.
struct View {
  Matrix4 eye_from_world = kIdentity;  ///< eye axes: x right, y up, -z forward
  float tan_left = 0.5f;
  float tan_right = 0.5f;
  float tan_up = 0.3f;
  float tan_down = 0.3f;
};

/// How holograms meet what is behind them.
enum class Blend {
  kAdditive,      ///< optical see-through: background + hologram
  kOver,          ///< preview: hologram over background by its opacity
  kPremultiplied  ///< over nothing, for another compositor to put over the world: colour times
                  ///< opacity, and the opacity itself as alpha
};

}  // namespace orthonav::render
