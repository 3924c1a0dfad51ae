#pragma once

#include <cstdint>
#include <vector>

#include "hal/sim/cameras/depth_model.h"
#include "hal/sim/cameras/room_renderer_bones.h"
#include "hal/sim/cameras/room_renderer_ground.h"
#include "hal/sim/cameras/room_renderer_solids.h"
#include "hal/sim/room/room.h"

namespace orthonav::sim {

/// The material that a pixel of a depth camera sees.
enum class Material : std::uint8_t {
  kNothing,
  kFloor,
  kDrape,
  kSkin,
  kTissue,
  kBone,
  kPaper,
  kMetal,
  kPlastic,
  kGlove
};

/// One pixel without any error of the sensor.
struct DepthSight {
  float range_m = 0.0F;  ///< along the ray; 0: nothing is there
  Material material = Material::kNothing;
};

/// The room as seen by a depth camera without measurement errors. Deterministic: the result depends
/// only on the arguments. One thread at a time.
class DepthRenderer {
 public:
  DepthRenderer(const RoomDescription& room, const DepthModel& model);
  /// One sight for each pixel, row-major.
  void render(const RoomState& state, std::vector<DepthSight>& sights);
  [[nodiscard]] const DepthCalibration& calibration() const { return calibration_; }

 private:
  /// Pixels [x0, x1) by [y0, y1).
  struct Window {
    int x0 = 0;
    int x1 = 0;
    int y0 = 0;
    int y1 = 0;
  };
  void see_ground(const Transform<LeftCamera, Spine>& camera_from_spine,
                  std::vector<DepthSight>& sights) const;
  void see_bones(const Transform<LeftCamera, Spine>& camera_from_spine,
                 std::vector<DepthSight>& sights);
  void see(const Plate& plate, std::vector<DepthSight>& sights) const;
  void see(const Capsule& capsule, std::vector<DepthSight>& sights) const;
  [[nodiscard]] Window window_around(Vec3 centre, double radius_m) const;
  template <class RangeAlong>
  void see_in(const Window& window, Material material, const RangeAlong& range_along,
              std::vector<DepthSight>& sights) const;

  DepthModel model_;
  DepthCalibration calibration_;
  Ground ground_;
  ShownBones bones_;
  ToolBodies bodies_;
  BoneImage bone_image_;
  Solids solids_;
};

}  // namespace orthonav::sim
