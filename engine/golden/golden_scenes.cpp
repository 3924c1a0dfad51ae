#include "engine/golden/golden_scenes.h"

#include "engine/golden/golden_stage.h"
#include "engine/holograms/label_layout.h"

namespace orthonav::engine {

std::vector<GoldenScene> golden_scenes() {
  std::vector<GoldenScene> scenes;
  golden::add_shape_scenes(scenes);
  golden::add_precision_scenes(scenes);
  golden::add_other_scenes(scenes);
  golden::add_step_scenes(scenes);
  golden::add_view_scenes(scenes);
  golden::add_label_scenes(scenes);
  for (GoldenScene& golden : scenes) {
    LabelLayout().lay_out(golden.scene, golden.views, golden.papers, Timestamp{});
  }
  return scenes;
}

RgbaImage golden_background(int width_px, int height_px) {
  RgbaImage image;
  image.width_px = width_px;
  image.height_px = height_px;
  const auto channel = [](int value) { return static_cast<std::uint8_t>(value); };
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      // Drapes green to blue, in the middle a wound, red; all in whole numbers.
      const int dx = 200 * x / width_px - 100;
      const int dy = 200 * y / height_px - 100;
      const bool wound = 4 * dx * dx + 9 * dy * dy < 4 * 70 * 70;
      const int uneven = (x / 9 + y / 7) % 5 * 4;
      image.pixels.push_back(channel(wound ? 118 + uneven : 34 + uneven));
      image.pixels.push_back(channel(wound ? 42 + uneven : 74 + uneven));
      image.pixels.push_back(channel(wound ? 38 + uneven : 78 + 20 * x / width_px));
      image.pixels.push_back(255);
    }
  }
  return image;
}

}  // namespace orthonav::engine
