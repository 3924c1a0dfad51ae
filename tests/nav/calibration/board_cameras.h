#pragma once

#include <numbers>

#include "nav/calibration/stereo_board.h"

namespace orthonav::nav::stereo_board_test {

struct Board;  // x along the columns, y down the rows, z away from who sees the face

inline const Chessboard kBoard{9, 6, 0.025};
inline constexpr ImageSize kSize{640, 480};

/// Two cameras, the right one upside down as those of a HoloLens 2 lie to each other.
struct Cameras {
  BrownConrady left{640, 480, 362.0, 361.0, 324.0, 238.0, -0.04, 0.01, 3e-4, -2e-4, 0.0};
  BrownConrady right{640, 480, 359.0, 360.0, 317.0, 243.0, -0.038, 0.009, -2e-4, 3e-4, 0.0};
  Transform<RightCamera, LeftCamera> right_from_left{
      rotation_from_vector({0, 0, std::numbers::pi}) * rotation_from_vector({0.01, -0.02, 0.005}),
      {0.001, 0.099, 0.003}};
};

inline Vec2 seen(const BrownConrady& camera, Vec3 p) {
  return camera.distort({p.x / p.z, p.y / p.z});
}

}  // namespace orthonav::nav::stereo_board_test
