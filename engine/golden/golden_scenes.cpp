#include "engine/golden/golden_scenes.h"

#include <array>

#include "engine/golden/golden_stage.h"
#include "engine/holograms/labels/label_layout.h"

namespace orthonav::engine {
namespace {

using Srgb = std::array<int, 3>;

/// Wound, drape, bone and glove of the simulated room as they pass the combiner, sRGB.
constexpr std::array<Srgb, 4> kGrounds = {
    {{80, 32, 26}, {22, 59, 63}, {103, 98, 82}, {68, 71, 74}}};

/// Drapes green to blue, in the middle a wound, red; all in whole numbers. `x` and `y` in percent
/// from the middle; its blue is even.
Srgb site_colour(int x, int y, int bluer) {
  const bool wound = 4 * x * x + 9 * y * y < 4 * 70 * 70;
  return wound ? Srgb{118, 42, 38} : Srgb{34, 74, 78 + bluer};
}

}  // namespace

std::vector<GoldenScene> golden_scenes(bool laid_out) {
  std::vector<GoldenScene> scenes;
  golden::add_shape_scenes(scenes);
  golden::add_precision_scenes(scenes);
  golden::add_number_scenes(scenes);
  golden::add_other_scenes(scenes);
  golden::add_step_scenes(scenes);
  golden::add_placed_scenes(scenes);
  golden::add_view_scenes(scenes);
  golden::add_label_scenes(scenes);
  for (GoldenScene& golden : scenes) {
    if (!laid_out) {
      break;
    }
    LabelLayout().lay_out(golden.scene, golden.views, golden.papers, Timestamp{});
  }
  golden::add_text_scenes(scenes);
  return scenes;
}

RgbaImage golden_background(int width_px, int height_px, GoldenBehind behind) {
  RgbaImage image;
  image.width_px = width_px;
  image.height_px = height_px;
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      const int uneven = (x / 9 + y / 7) % 5 * 4;
      const bool right = 2 * x >= width_px;
      const bool below = 2 * y >= height_px;
      const Srgb colour = behind == GoldenBehind::kSite
                              ? site_colour(200 * x / width_px - 100, 200 * y / height_px - 100,
                                            20 * x / width_px - uneven)
                              : kGrounds[(below ? 2U : 0U) + (right ? 1U : 0U)];
      for (const int channel : colour) {
        image.pixels.push_back(static_cast<std::uint8_t>(channel + uneven));
      }
      image.pixels.push_back(255);
    }
  }
  return image;
}

}  // namespace orthonav::engine
