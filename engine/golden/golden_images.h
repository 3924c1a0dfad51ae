#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "engine/golden/golden_scenes.h"
#include "render/compare.h"

namespace orthonav::engine {

/// The images of a scene, with views side by side.
struct GoldenImages {
  LabelImage labels;
  RgbaImage additive;  ///< on black, as a headset shows it
  RgbaImage over;      ///< over golden_background
};

/// Draws golden scenes. Keeps one renderer and background per size, so that many scenes cost
/// little.
class GoldenPainter {
 public:
  /// The goldens were made with this rasterizer; others round differently.
  static constexpr const char* kPinnedDevice = "llvmpipe";
  /// With validation, its lines go to `messages` too, which may outlive the painter.
  explicit GoldenPainter(std::string device = kPinnedDevice, bool validation = false,
                         render::MessageSink messages = nullptr);
  Result<GoldenImages> paint(const GoldenScene& scene);
  /// The messages of all renderers used so far.
  [[nodiscard]] const std::vector<std::string>& validation_messages() const { return *messages_; }

 private:
  using Size = std::pair<int, int>;
  Result<render::Renderer*> renderer_for(const GoldenScene& scene, render::Blend blend);
  std::string device_;
  bool validation_;
  render::MessageSink messages_;
  std::map<std::pair<Size, render::Blend>, std::unique_ptr<render::Renderer>> renderers_;
  std::map<std::pair<Size, GoldenBehind>, RgbaImage> backgrounds_;
};

/// File names of one scene's goldens: labels, additive, over.
[[nodiscard]] std::vector<std::string> golden_files(const std::string& scene_name);

Result<GoldenImages> read_goldens(const std::filesystem::path& folder,
                                  const std::string& scene_name);
/// Writes all three, each completely or not at all.
Status write_goldens(const std::filesystem::path& folder, const std::string& scene_name,
                     const GoldenImages& images);

/// The differences between expected and drawn images; empty if there are none.
[[nodiscard]] std::vector<std::string> differences(const GoldenImages& expected,
                                                   const GoldenImages& actual);

/// PNG files in the folder that belong to no scene.
[[nodiscard]] std::vector<std::string> orphaned_goldens(const std::filesystem::path& folder,
                                                        const std::vector<GoldenScene>& scenes);

}  // namespace orthonav::engine
