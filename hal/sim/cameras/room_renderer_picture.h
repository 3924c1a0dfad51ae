#pragma once

#include <vector>

#include "hal/sim/cameras/room_renderer_bones.h"
#include "hal/sim/cameras/room_renderer_layers.h"

namespace orthonav::sim {

/// Paints the room in colour for people. The image keeps the size that it comes with; an empty
/// image becomes 960×540.
class PicturePainter {
 public:
  PicturePainter(const RoomDescription& room, const Ground& ground);
  void paint(const RoomState& state, const PinholeView& view, const ToolBodies& bodies,
             RgbaImage& image);

 private:
  struct GroundView;
  void paint_coarse_ground(const GroundView& ground);
  /// Coarsely, but finely where colours meet.
  void paint_ground(const GroundView& ground);
  void paint_bones(const PinholeLens& lens, const Transform<LeftCamera, Spine>& camera_from_spine);
  void encode_light(RgbaImage& image) const;
  static void lay_over(const Foreground& bodies, float opacity, RgbaImage& image);

  const Ground& ground_;
  ShownBones bones_;
  BoneImage bone_image_;
  Layers layers_;
  Foreground foreground_;
  Foreground hand_;  ///< apart from the tools where it hides less than it would
  Solids solids_;
  Solids hand_solids_;
  int width_ = 0;
  int height_ = 0;
  std::vector<std::array<float, 3>> coarse_;  ///< linear light, half resolution
  std::vector<float> coarse_nearness_;
  std::vector<std::array<float, 3>> light_;
  std::vector<float> nearness_;
  std::vector<std::uint8_t> encode_;  ///< linear light in 1/4095 to sRGB
};

}  // namespace orthonav::sim
