#include "engine/holograms/scene_file.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// Scripted scenes of `orthonav render`: an accepted one is seen by two eyes.
void fuzz_drawing(std::span<const std::uint8_t> input) {
  const auto scene = engine::parse_scene(text_of(input), "scene", "/nonexistent");
  if (!scene) {
    insist_one_line(scene.error());
    return;
  }
  insist(scene->eyes.size() == 2 && scene->width_px > 0 && scene->height_px > 0);
}

}  // namespace orthonav::fuzz
