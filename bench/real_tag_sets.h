#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/real_tags.h"

namespace orthonav::bench {

/// 23 stereo pairs of a board of 4 x 5 tag36h10 with the cameras' calibration; nothing where the
/// data are absent. The print's scale is that of the mean pitch as AprilTag's corners triangulate
/// it.
[[nodiscard]] std::optional<BoardPictures> stereo_pairs();

/// 30 pictures of an AprilGrid of 6 x 6, by a camera and before a board whose poses were measured
/// by motion capture.
struct CapturedPictures {
  BoardPictures pictures;  ///< the lens fitted to all corners that AprilTag finds
  std::vector<Transform<World, Marker>> world_from_body;  ///< of the camera's housing, a frame each
  Transform<World, Tag> world_from_target;
};
[[nodiscard]] std::optional<CapturedPictures> captured_pictures();

/// 15 pictures of one tag that was turned by hand.
struct TurnedTag {
  BoardPictures pictures;          ///< a board of one row that ends with the tag
  std::vector<double> turned_deg;  ///< as their names state
  int id = 0;
};
[[nodiscard]] std::optional<TurnedTag> turned_tag();

}  // namespace orthonav::bench
