#pragma once

#include <vector>

#include "base/vec.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

/// Directions on the unit plane, one for each pixel, row-major; NaN: the pixel has none.
struct UnitPlaneTable {
  int width_px = 0;
  int height_px = 0;
  std::vector<Vec2> entries;
};

/// From two tables of float32 as a headset sends them: x and y at integer pixel coordinates, which
/// are the pixels' top-left corners; both spans must be long enough. Entries (0, 0) have no
/// direction, unless their neighbours look straight ahead too: a headset leaves zeros where its
/// mapping failed. Others are unchanged and may be NaN.
[[nodiscard]] UnitPlaneTable read_unit_plane(int width_px, int height_px, Bytes x, Bytes y);

/// From a pixel's corner to its centre.
inline constexpr double kHalfPixel = 0.5;

/// The table half a pixel to the right and down (`ahead` 0.5), or back (-0.5): cubic through the
/// four nearest entries along each axis, carried on past the edges.
[[nodiscard]] UnitPlaneTable resampled(const UnitPlaneTable& table, double ahead);

}  // namespace orthonav::hl2ss
