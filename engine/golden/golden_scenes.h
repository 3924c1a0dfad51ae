#pragma once

#include <string>
#include <vector>

#include "engine/holograms/labels/glare_patches.h"
#include "render/renderer.h"

namespace orthonav::engine {

/// A point of a hologram whose position in the image is asserted as a number.
struct GoldenPoint {
  render::Label label = 0;
  render::Float3 in_world{};
};

/// The background behind the holograms of an `over` picture.
enum class GoldenBehind {
  kSite,        ///< drapes, and a wound in the middle
  kFourGrounds  ///< wound, drape above, bone, glove below: as the simulated room shows them
};

/// A golden picture: what is drawn, from where, and how large.
struct GoldenScene {
  std::string name;
  std::string what;  ///< what a reviewer should see, one line
  int width_px = 360;
  int height_px = 234;
  GoldenBehind behind = GoldenBehind::kSite;
  render::Scene scene;
  std::vector<render::View> views;
  std::vector<GlarePatch> papers;  ///< tags that labels avoid; not drawn
  /// Points that the hologram must cover.
  std::vector<GoldenPoint> covered;
  /// Centres of holograms that are symmetric about them, without text.
  std::vector<GoldenPoint> centred;
};

/// Every golden scene, in a fixed order; the same values at every call. For controls also before
/// anything made way for anything.
[[nodiscard]] std::vector<GoldenScene> golden_scenes(bool laid_out = true);

/// The background of the `over` pictures, slightly uneven.
[[nodiscard]] RgbaImage golden_background(int width_px, int height_px,
                                          GoldenBehind behind = GoldenBehind::kSite);

}  // namespace orthonav::engine
