#pragma once

#include "engine/golden/golden_images.h"

namespace orthonav::engine {

// Ways to spoil pictures as a renderer could, each of which the comparison must notice.

/// Every view mirrored, left to right.
[[nodiscard]] GoldenImages mirrored(const GoldenImages& images, int views);
/// Left and right eye in each other's place.
[[nodiscard]] GoldenImages eyes_swapped(const GoldenImages& images);

}  // namespace orthonav::engine
