#pragma once

#include <set>
#include <vector>

#include "engine/golden/golden_scenes.h"

namespace orthonav::engine {

// Ways to spoil a scene, each of which the comparison must notice.

[[nodiscard]] std::set<render::Label> labels_in(const render::Scene& scene);
[[nodiscard]] GoldenScene without(GoldenScene golden, render::Label label);
[[nodiscard]] GoldenScene only(GoldenScene golden, render::Label label, bool with_text);
[[nodiscard]] GoldenScene only_shapes(GoldenScene golden);
/// Pixels of the first view.
struct PixelStep {
  float right = 0;
  float down = 0;
};
/// Moved so far that each point shifts by the step in the first view.
[[nodiscard]] GoldenScene moved(GoldenScene golden, render::Label label, PixelStep step);
/// A fifth less light.
[[nodiscard]] GoldenScene dimmed(GoldenScene golden, render::Label label);
/// Scenes that differ from the given one by a single number each, for every run of digits in every
/// text: its last digit becomes the next one. Empty when the scene shows no number.
[[nodiscard]] std::vector<GoldenScene> with_one_number_changed(const GoldenScene& golden);

}  // namespace orthonav::engine
