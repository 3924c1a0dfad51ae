#pragma once

#include <vector>

#include "hal/sim/cameras/room_renderer.h"
#include "hal/sim/cameras/room_renderer_bones.h"
#include "hal/sim/cameras/room_renderer_ground.h"
#include "hal/sim/cameras/room_renderer_layers.h"
#include "hal/sim/cameras/room_renderer_picture.h"
#include "hal/sim/cameras/room_renderer_sensor.h"

namespace orthonav::sim {

/// The renderer on one core: a coarse background (cloth, wound, bones), bodies with exact area
/// coverage over it, one pass of the sensor.
class SoftwareRoomRenderer final : public RoomRenderer {
 public:
  SoftwareRoomRenderer(RoomDescription room, const ErrorModel& error_model);
  void render(std::span<const RoomState> states, const CameraModel& camera,
              const Transform<LeftCamera, Rig>& camera_from_rig, std::uint64_t noise_seed,
              GreyImage& image) override;
  void picture(const RoomState& state, const PinholeView& view, RgbaImage& image) override;

 private:
  void draw_background(const CameraLens& lens,
                       const Transform<LeftCamera, Spine>& camera_from_spine);

  void draw_ground(const CameraLens& lens, const Transform<Spine, LeftCamera>& spine_from_camera);

  RoomDescription room_;
  Ground ground_;
  ShownBones coarse_bones_;
  ErrorModel error_model_;
  ToolBodies bodies_;
  Sensor sensor_;
  Layers layers_;
  Foreground foreground_;
  Solids solids_;
  HalfImage quarter_;
  HalfImage background_;
  std::vector<Ground::Kind> kinds_;
  BoneImage bone_image_;
  PicturePainter painter_;
};

}  // namespace orthonav::sim
