#pragma once

#include <cstddef>

#include "engine/holograms/labels/label_geometry.h"
#include "render/scene.h"

namespace orthonav::engine {

// Possible places of a label around the thing it names. Lengths are in its cap heights.

/// Order of importance: earlier ones are placed first, and later ones avoid them.
enum class LabelRank {
  kFixed,       ///< not moved by itself: the status line, the texts about the cross
  kMeasured,    ///< a check point's distance, a rod's length, a tip's distance, a measured wire
  kNamed,       ///< an entry point's name
  kIncidental,  ///< a rod's bend: left out if there is no room
};
[[nodiscard]] LabelRank rank_of(const render::TextItem& text);

struct LabelPlace {
  render::TextAlign align = render::TextAlign::kLeft;
  float right = 0;  ///< as TextItem's offsets
  float up = 0;
  bool led = false;   ///< so far off that it needs a thin line
  bool mine = false;  ///< the builder's own place
};

/// The extent of a label's ink: the width of its line with overhang, and heights from its baseline.
struct LabelExtent {
  float width = 0;
  float aside = 0.1f;
  float below = 0.25f;
  float above = 1.05f;
};
[[nodiscard]] CapsBox box_at(const LabelPlace& place, const LabelExtent& extent);

/// Places are numbered in order of preference; 0 is the builder's.
[[nodiscard]] std::size_t count_of_places();
[[nodiscard]] LabelPlace place_of(const render::TextItem& as_built, const LabelExtent& extent,
                                  std::size_t place);

}  // namespace orthonav::engine
