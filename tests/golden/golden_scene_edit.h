#pragma once

#include <set>
#include <string>

#include "engine/golden_scenes.h"

namespace orthonav::engine {

// Ways to spoil a scene, each of which the comparison must notice.

[[nodiscard]] std::set<render::Label> labels_in(const render::Scene& scene);
[[nodiscard]] GoldenScene without(GoldenScene golden, render::Label label);
[[nodiscard]] GoldenScene only(GoldenScene golden, render::Label label, bool with_text);
/// To the right in the first view, as far as a pixel is wide there, times `pixels`.
[[nodiscard]] GoldenScene moved(GoldenScene golden, render::Label label, float pixels);
/// A fifth less light.
[[nodiscard]] GoldenScene dimmed(GoldenScene golden, render::Label label);
/// The last digit of the first text that has one becomes the next digit; false without a digit.
[[nodiscard]] bool change_digit(GoldenScene& golden, render::Label label);

}  // namespace orthonav::engine
