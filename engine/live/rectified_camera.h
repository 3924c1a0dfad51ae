#pragma once

#include <vector>

#include "base/image.h"
#include "base/vec.h"
#include "hal/api/devices.h"
#include "render/scene.h"

namespace orthonav::engine {

/// The left camera's images rectified: as seen by an eye at the camera's place with the headset's
/// axes, so that holograms can be drawn over them. One thread.
class RectifiedCamera {
 public:
  explicit RectifiedCamera(const StereoCalibration& cameras) : cameras_(cameras) {}

  /// Where the left camera is in the headset.
  [[nodiscard]] Transform<Rig, Eye> rig_from_eye() const;
  /// Draws the image into the picture; where the camera sees nothing, the picture stays as it is.
  void draw(const GreyImage& image, const render::View& view, RgbaImage& picture);

 private:
  void make_map(const render::View& view, const RgbaImage& picture);

  StereoCalibration cameras_;
  /// For each pixel of the picture the camera's pixel; x < 0: none.
  std::vector<Vec2> map_;
  float map_tan_ = 0.0f;
};

}  // namespace orthonav::engine
