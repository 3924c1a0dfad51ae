#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "engine/holograms/shapes/hologram_shapes.h"
#include "engine/session/steps/guiding.h"

namespace orthonav::engine {

/// The eyes' position and the head's up direction, for holograms that face the eyes.
struct Viewer {
  render::Float3 eye{};
  render::Float3 up{0, 1, 0};  ///< unit
};

/// The tool against the plan, as the cross shows it.
struct CrossReading {
  render::Float3 tip_offset{};  ///< from the planned axis, perpendicular to it, in the world
  render::Float3 top_offset{};  ///< of the tool's axis, 80 mm up
  Grade grade = Grade::kPoor;
  /// The element that is drawn bright; of angle or offset also the way to move it.
  Worst worst = Worst::kNothing;
};

/// H7: a target that faces the eyes, above the site as they see it and to a side, clear of the
/// tool. Its rings are at 1, 2 and 5 mm, magnified four times.
struct TargetCross {
  render::Float3 site{};
  render::Float3 outward{};  ///< unit, along the planned axis out of the bone
  Viewer viewer;
  LabelSide side = LabelSide::kLeft;    ///< of the site, as the eyes see it
  std::optional<CrossReading> reading;  ///< absent: rings without dots
  bool lost = false;                    ///< the cross says so in place of the dots
};

/// H6, H9 and the offset: what is written under the cross, and the bar beside it.
struct CrossNumbers {
  std::optional<nav::ScrewSizes> sizes;  ///< absent: dashes in place of the angle, no offset
  std::optional<nav::ShownDepth> depth;
  Grade grade = Grade::kPoor;
  Worst worst = Worst::kNothing;
  float way = 0.0f;       ///< of the planned depth, in [0, 1]; fills the bar
  bool drilling = false;  ///< the bar is larger
};

inline constexpr float kCrossAbove_m = 0.060f;
inline constexpr float kCrossAside_m = 0.065f;
inline constexpr float kCrossScale = 4.0f;
inline constexpr std::array<float, 3> kCrossRings_m = {0.001f, 0.002f, 0.005f};

/// Where the parts of the cross are: its middle, the filled and the hollow dot (at the middle
/// without a reading). A dot past the rings stays at their rim; the way to move leads from the dot
/// that is worst to where it belongs.
struct CrossPlaces {
  render::Float3 middle{};
  render::Float3 right{};  ///< unit, of the disc
  render::Float3 up{};
  render::Float3 normal{};               ///< towards the eyes
  std::array<render::Float3, 2> dots{};  ///< tip, top
  std::optional<std::array<render::Float3, 2>> way;
};
/// The side away from which the planned axis leans; unchanged while it hardly leans, so that it
/// does not jump.
[[nodiscard]] LabelSide clear_side(render::Float3 site, render::Float3 outward,
                                   const Viewer& viewer, LabelSide until_now);
[[nodiscard]] CrossPlaces places_of(const TargetCross& cross);

/// Rings carry `label`, dots and the way to move the next one.
void add_target_cross(render::Scene& scene, const TargetCross& cross, render::Label label);
/// The outermost ring of a drawn cross; absent: the scene shows none.
struct CrossDisc {
  render::Float3 middle{};
  float radius_m = 0;
  const render::LineItem* ring = nullptr;  ///< never null
};
[[nodiscard]] std::optional<CrossDisc> disc_of(const render::Scene& scene, render::Label label);
/// Takes the dots off a drawn cross and says that the tool is lost.
void take_dots_off(render::Scene& scene, render::Label label);

/// The labels of what `add_cross_numbers` adds.
struct CrossLabels {
  render::Label angle = 0;
  render::Label offset = 0;
  render::Label depth = 0;  ///< also of the bar
};
/// Three rows centred under the cross: the angle, `tip 0.4 mm`, `31.0 mm to target`; the worst of
/// them white in a rim of its colour, the others plain. Beside the cross a bar from the entry down
/// to the target that fills as the tip advances.
void add_cross_numbers(render::Scene& scene, const TargetCross& cross, const CrossNumbers& numbers,
                       const CrossLabels& labels);
/// Above the cross, in a rim: an alarm, larger, or what may happen.
void add_cross_word(render::Scene& scene, const TargetCross& cross, std::string_view word,
                    const render::Colour& rim, bool larger, render::Label label);

/// Away from the cross, while it is not shown: the distance from the entry, at the tip.
void add_tip_distance(render::Scene& scene, render::Float3 tip, double distance_m,
                      render::Label label);

}  // namespace orthonav::engine
