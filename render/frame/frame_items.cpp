#include "render/frame/frame_items.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/float3.h"
#include "render/frame/draw_order.h"
#include "render/thinned.h"

namespace orthonav::render {
namespace {

constexpr std::size_t kFewPoints = 256;  // a line with no more points is cheap as it is

}  // namespace

Matrix4 world_from_caps(const TextItem& item, const Head& head) {
  const Float3 p = item.position;
  const Float3 at = item.place == TextPlace::kWorld
                        ? p
                        : head.position + p.x * head.right + p.y * head.up + p.z * head.back;
  // Facing the point between the eyes, so that both eyes see the same thing in space.
  const Float3 towards = unit_or(head.position - at, head.back);
  const Float3 right = unit_or(cross(head.up, towards), head.right);
  const Float3 up = cross(towards, right);
  const float least_rad = item.min_height_deg * std::numbers::pi_v<float> / 180.0f;
  const float least_m = 2.0f * std::tan(0.5f * least_rad) * length(head.position - at);
  const float cap_m = std::max(item.height_m, least_m);
  return {Float4(cap_m * right, 0), Float4(cap_m * up, 0), Float4(towards, 0), Float4(at, 1)};
}

void FrameItems::build(const Scene& scene, const std::vector<View>& views, const Font& font,
                       const BoxOf& box_of, float least_rad, HeadTexts head_texts) {
  translucent_meshes_.clear();
  solids_.clear();
  triangles_.clear();
  lines_.clear();
  texts_.clear();
  data_.clear();
  most_segments_ = 0;
  const Head head = head_of(views);
  eyes_.clear();
  for (const View& view : views) {
    eyes_.push_back(transformed(rigid_inverse(view.eye_from_world), {0, 0, 0}));
  }
  sort_for_drawing(scene.meshes, head, box_of, order_);
  for (const std::uint32_t i : order_) {
    const MeshItem& item = scene.meshes[i];
    (is_opaque(item) ? solids_ : translucent_meshes_).push_back({&item, {}});
  }
  sort_for_drawing(scene.triangles, head, order_);
  for (const std::uint32_t i : order_) {
    const TriangleItem& item = scene.triangles[i];
    triangles_.push_back(
        {item.label, item.colour, 0, static_cast<std::uint32_t>(data_.size()), 3, {}});
    for (const Float3 p : item.corners) {
      data_.push_back({p.x, p.y, p.z, 1});
    }
  }
  sort_for_drawing(scene.lines, head, order_);
  lines_of_scene_ = scene.lines.data();
  for (const std::uint32_t i : order_) {
    add_line(scene.lines[i], least_rad);
  }
  add_texts(scene, head, font, head_texts);
}

void FrameItems::add_texts(const Scene& scene, const Head& head, const Font& font,
                           HeadTexts head_texts) {
  sort_for_drawing(scene.texts, head, order_);
  for (const std::uint32_t i : order_) {
    if (head_texts == HeadTexts::kDrawn || scene.texts[i].place != TextPlace::kView) {
      add_text(scene.texts[i], head, font);
    }
  }
}

void FrameItems::add_segment(Float3 a, Float3 b) {
  data_.push_back({a.x, a.y, a.z, 1});
  data_.push_back({b.x, b.y, b.z, 1});
}

void FrameItems::add_line(const LineItem& item, float least_rad) {
  if (item.points.empty()) {
    return;
  }
  const auto first = static_cast<std::uint32_t>(data_.size());
  if (item.dash_m > 0) {
    add_dashes(item);
  } else if (item.points.size() > kFewPoints && least_rad > 0) {
    return add_many(item, least_rad);
  } else {
    for (std::size_t i = 1; i < item.points.size(); ++i) {
      add_segment(item.points[i - 1], item.points[i]);
    }
    if (item.closed && item.points.size() > 2) {
      add_segment(item.points.back(), item.points.front());
    }
    if (item.points.size() == 1) {
      add_segment(item.points[0], item.points[0]);
    }
  }
  end_line(item, first, true);
}

void FrameItems::end_line(const LineItem& item, std::uint32_t first, bool rounded) {
  const auto count = (static_cast<std::uint32_t>(data_.size()) - first) / 2;
  if (count == 0) {
    return;
  }
  const auto id = static_cast<std::uint32_t>(&item - lines_of_scene_);
  lines_.push_back({item.label, item.colour, item.width_m, first, count, {}, id, rounded});
  most_segments_ = std::max(most_segments_, count);
}

/// A line of many points as two spans: the segments at its ends and corners, and all others.
void FrameItems::add_many(const LineItem& item, float least_rad) {
  thin(item.points, eyes_, least_rad, thinned_);
  if (item.closed) {
    thinned_.push_back(thinned_.front());
  }
  const std::size_t points = thinned_.size();
  const auto follows_on = [&](std::size_t i) {
    return i > 0 && i + 1 < points &&
           bends_gently(thinned_[i - 1], thinned_[i], thinned_[i + 1], eyes_);
  };
  plain_.clear();
  const auto first = static_cast<std::uint32_t>(data_.size());
  bool gentle_before = false;
  for (std::size_t i = 1; i < points; ++i) {
    const bool gentle_after = follows_on(i);
    if (gentle_before && gentle_after) {
      plain_.push_back(i);
    } else {
      add_segment(thinned_[i - 1], thinned_[i]);
    }
    gentle_before = gentle_after;
  }
  end_line(item, first, true);
  const auto second = static_cast<std::uint32_t>(data_.size());
  for (const std::size_t i : plain_) {
    add_segment(thinned_[i - 1], thinned_[i]);
  }
  end_line(item, second, false);
}

void FrameItems::add_dashes(const LineItem& item) {
  // Round ends extend half a width beyond a segment; they are taken off, so that dash and gap have
  // equal length.
  const float inset_m = std::min(0.5f * item.width_m, 0.499f * item.dash_m);
  const std::size_t count = item.points.size();
  const std::size_t spans = item.closed && count > 2 ? count : count - 1;
  float phase_m = inset_m;  // how far into the pattern of dash and gap the span begins
  for (std::size_t i = 0; i < spans; ++i) {
    const Float3 a = item.points[i];
    const Float3 b = item.points[(i + 1) % count];
    const float span_m = length(b - a);
    if (!(span_m > 0)) {
      continue;
    }
    const float period_m = 2 * item.dash_m;
    // Whole periods are counted, not summed, so that no error accumulates along a long line.
    const auto periods = static_cast<int>((phase_m + span_m) / period_m);
    for (int k = 0; k <= periods; ++k) {
      const float begin_m = static_cast<float>(k) * period_m - phase_m + inset_m;
      const float from_m = std::max(begin_m, 0.0f);
      const float to_m = std::min(begin_m + item.dash_m - 2 * inset_m, span_m);
      if (from_m > to_m) {
        continue;
      }
      add_segment(a + (from_m / span_m) * (b - a), a + (to_m / span_m) * (b - a));
    }
    phase_m = std::fmod(phase_m + span_m, period_m);
  }
}

void FrameItems::add_text(const TextItem& item, const Head& head, const Font& font) {
  glyphs_.clear();
  lay_out(font, item, glyphs_);
  if (glyphs_.empty()) {
    return;
  }
  const auto first = static_cast<std::uint32_t>(data_.size());
  const float across = 1.0f / static_cast<float>(font.header().width_px);
  const float down = 1.0f / static_cast<float>(font.header().height_px);
  for (const PlacedGlyph& glyph : glyphs_) {
    const FontFileGlyph& source = *glyph.glyph;
    data_.push_back({glyph.left, glyph.bottom, glyph.right, glyph.top});
    data_.push_back({across * static_cast<float>(source.u0), down * static_cast<float>(source.v0),
                     across * static_cast<float>(source.u1), down * static_cast<float>(source.v1)});
    data_.push_back({glyph.colour.r, glyph.colour.g, glyph.colour.b, glyph.colour.a});
  }
  texts_.push_back({item.label,
                    world_from_caps(item, head),
                    item.rim,
                    first,
                    static_cast<std::uint32_t>(glyphs_.size()),
                    {}});
}

}  // namespace orthonav::render
