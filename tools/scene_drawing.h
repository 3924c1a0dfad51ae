#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/transform.h"
#include "hal/hl2ss/server/unity_scene.h"
#include "render/projection.h"
#include "render/renderer.h"
#include "tools/out_folder.h"

namespace orthonav::tools {

/// The single label of everything in the headset's scene, which does not distinguish holograms.
inline constexpr render::Label kRemoteLabel = 1;

/// A stand-in's scene for our renderer. Cylinders become lines of the same width, which face the
/// eye; texts are drawn in our font, upright to the head.
[[nodiscard]] render::Scene drawn_scene(const hl2ss::UnityObjects& objects,
                                        const render::Head& head);

/// Writes pictures of a stand-in's scene, seen from between the wearer's eyes, with a HoloLens 2's
/// field of view and pixels.
class ScenePictures {
 public:
  /// An Error when the folder can't be made, or no Vulkan device is suitable.
  static Result<std::unique_ptr<ScenePictures>> create(const std::string& folder);
  /// `scene-0001.png` and so on.
  Status draw(const hl2ss::UnityObjects& objects, const Transform<World, Rig>& world_from_rig);

 private:
  ScenePictures(OutFolder folder, std::unique_ptr<render::Renderer> renderer)
      : folder_(std::move(folder)), renderer_(std::move(renderer)) {}

  OutFolder folder_;
  std::unique_ptr<render::Renderer> renderer_;
  std::vector<RgbaImage> images_;
  int count_ = 0;
};

}  // namespace orthonav::tools
