#pragma once

#include <cstddef>

#include "engine/holograms/label_geometry.h"
#include "render/scene.h"

namespace orthonav::engine {

// Where a label may stand about what it names. Lengths are in its cap heights.

/// Of importance: whoever comes first is placed first, and others make way.
enum class LabelRank {
  kFixed,       ///< never moved: the status line, the texts on the target cross
  kGuiding,     ///< the angle, with the depth under it
  kMeasured,    ///< a check point's distance, a rod's length
  kNamed,       ///< an entry point's name
  kIncidental,  ///< a rod's bend: the only one to be left out where there is no room
};
[[nodiscard]] LabelRank rank_of(const render::TextItem& text);

struct LabelPlace {
  render::TextAlign align = render::TextAlign::kLeft;
  float right = 0;  ///< as TextItem's offsets
  float up = 0;
  bool led = false;   ///< so far off that a thin line leads to it
  bool mine = false;  ///< as the builder wrote it
};

/// How far a label's ink reaches: its line's width and what juts out of it, and from its baseline.
struct LabelExtent {
  float width = 0;
  float aside = 0.1f;
  float below = 0.25f;
  float above = 1.05f;
};
[[nodiscard]] CapsBox box_at(const LabelPlace& place, const LabelExtent& extent);

/// In order of preference; 0 is where the builder put it.
[[nodiscard]] std::size_t count_of_places(const render::TextItem& text);
[[nodiscard]] LabelPlace place_of(const render::TextItem& as_built, const LabelExtent& extent,
                                  std::size_t place);

}  // namespace orthonav::engine
