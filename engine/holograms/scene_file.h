#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "render/scene.h"

namespace orthonav::engine {

/// Holograms scripted by users (docs/scene-files.md), and the eyes that see them.
struct SceneFile {
  render::Scene scene;
  std::vector<render::View> eyes;  ///< left, right
  int width_px = 1268;             ///< of one eye
  int height_px = 720;
};

/// Reads a scene file and the meshes that it names. Refuses, with file, place, value and limit,
/// anything it can't draw: unknown holograms, numbers that are not finite, widths that are not
/// positive.
Result<SceneFile> load_scene(const std::string& path);
/// The same from a file's text; `name` stands for the file in messages, `folder` is the folder of
/// its meshes.
Result<SceneFile> parse_scene(const std::string& text, const std::string& name,
                              const std::string& folder);

}  // namespace orthonav::engine
