#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

#include "nav/tracking/marker_detector.h"

struct apriltag_family;

namespace orthonav::nav {

/// tag36h11 with a black border two cells wide.
inline constexpr std::string_view kWideFamily = "tag36h11b2";

/// A family as the AprilTag library holds it; knows which of `known_families()` it is.
struct FreeFamily {
  std::size_t index = 0;
  void operator()(apriltag_family* family) const;
};
using TagFamily = std::unique_ptr<apriltag_family, FreeFamily>;

/// Null for an unknown family, or if memory runs out.
[[nodiscard]] TagFamily create_family(std::string_view name);

}  // namespace orthonav::nav
