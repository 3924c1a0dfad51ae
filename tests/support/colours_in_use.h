#pragma once

#include "engine/holograms/shapes/hologram_colours.h"

namespace orthonav::test {

/// While it lives, holograms have these colours in this process; the standard ones afterwards.
class ColoursInUse {
 public:
  explicit ColoursInUse(const engine::HologramColours& colours) { engine::use_colours(colours); }
  ~ColoursInUse() { engine::use_colours({}); }
  ColoursInUse(const ColoursInUse&) = delete;
  ColoursInUse& operator=(const ColoursInUse&) = delete;
};

}  // namespace orthonav::test
