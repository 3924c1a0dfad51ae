#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "base/transform.h"
#include "engine/io/video_writer.h"
#include "hal/hl2ss/server/unity_scene.h"
#include "render/projection.h"
#include "render/renderer.h"
#include "tools/orthonav/shared/out_folder.h"

namespace orthonav::tools {

/// The single label of everything in the headset's scene, which does not distinguish holograms.
inline constexpr render::Label kRemoteLabel = 1;

/// A stand-in's scene for our renderer. Cylinders become lines of the same width, which face the
/// eye; texts are drawn in our font, upright to the head.
[[nodiscard]] render::Scene drawn_scene(const hl2ss::UnityObjects& objects,
                                        const render::Head& head);

/// Draws a stand-in's scene as seen from between the wearer's eyes, with a HoloLens 2's field of
/// view.
class SceneEye {
 public:
  /// `scale`: of a HoloLens 2's pixels. An Error when no Vulkan device is suitable.
  static Result<std::unique_ptr<SceneEye>> create(double scale);
  /// Valid until the next call.
  Result<const RgbaImage*> draw(const hl2ss::UnityObjects& objects,
                                const Transform<World, Rig>& world_from_rig);

 private:
  explicit SceneEye(std::unique_ptr<render::Renderer> renderer) : renderer_(std::move(renderer)) {}

  std::unique_ptr<render::Renderer> renderer_;
  std::vector<RgbaImage> images_;
};

/// Writes pictures of a stand-in's scene.
class ScenePictures {
 public:
  /// An Error when the folder can't be made, or no Vulkan device is suitable.
  static Result<std::unique_ptr<ScenePictures>> create(const std::string& folder);
  /// `scene-0001.png` and so on.
  Status draw(const hl2ss::UnityObjects& objects, const Transform<World, Rig>& world_from_rig);

 private:
  ScenePictures(OutFolder folder, std::unique_ptr<SceneEye> eye)
      : folder_(std::move(folder)), eye_(std::move(eye)) {}

  OutFolder folder_;
  std::unique_ptr<SceneEye> eye_;
  int count_ = 0;
};

/// Films a stand-in's scene in real time, ten pictures a second, from the first time that anything
/// is shown.
class SceneFilm {
 public:
  /// An MP4 file, at half a HoloLens 2's pixels.
  static Result<std::unique_ptr<SceneFilm>> create(const std::string& path);
  /// Appends as many pictures as have become due; where the last one took long, the new one several
  /// times, so that the film keeps time.
  Status look(const hl2ss::UnityObjects& objects, const Transform<World, Rig>& world_from_rig);
  /// Completes the file; without a picture there is none.
  Status finish();

 private:
  SceneFilm(std::string path, std::unique_ptr<SceneEye> eye)
      : path_(std::move(path)), eye_(std::move(eye)) {}

  std::string path_;
  std::unique_ptr<SceneEye> eye_;
  std::unique_ptr<engine::VideoWriter> video_;  ///< null before the first picture
  std::optional<Stopwatch> since_first_;
};

}  // namespace orthonav::tools
