#pragma once

#include <array>
#include <optional>

#include "engine/holograms/hologram_shapes.h"
#include "engine/session/numbers_wording.h"

namespace orthonav::engine {

/// The eyes' position and the head's up direction, for holograms that face the eyes.
struct Viewer {
  render::Float3 eye;
  render::Float3 up{0, 1, 0};  ///< unit
};

/// The tool's offset from the planned axis, perpendicular to it, in the world.
struct CrossReading {
  render::Float3 tip_offset;
  render::Float3 top_offset;  ///< of the tool's axis, 80 mm up
  Grade grade = Grade::kPoor;
};

/// H7: a target that faces the eyes, above the site as they see it and to a side, clear of the tool
/// and of the number beside it. Its rings are at 1, 2 and 5 mm, magnified four times.
struct TargetCross {
  render::Float3 site;
  render::Float3 outward;  ///< unit, along the planned axis out of the bone
  Viewer viewer;
  LabelSide side = LabelSide::kLeft;    ///< of the site, as the eyes see it
  std::optional<CrossReading> reading;  ///< absent: rings without dots
  bool lost = false;                    ///< the cross says so in place of the dots
};

inline constexpr float kCrossAbove_m = 0.060f;
inline constexpr float kCrossAside_m = 0.065f;
inline constexpr float kCrossScale = 4.0f;
inline constexpr std::array<float, 3> kCrossRings_m = {0.001f, 0.002f, 0.005f};

/// Where the parts of the cross are: its middle, the filled and the hollow dot (at the middle
/// without a reading). A dot past the rings stays at their rim.
struct CrossPlaces {
  render::Float3 middle;
  render::Float3 right;  ///< unit, of the disc
  render::Float3 up;
  render::Float3 normal;                    ///< towards the eyes
  std::array<render::Float3, 2> dots;       ///< tip, top
  std::array<bool, 2> outside = {};         ///< past the rim
  std::array<render::Float3, 2> towards{};  ///< unit, from the middle to the dot
};
/// The side away from which the planned axis leans; unchanged while it hardly leans, so that it
/// does not jump.
[[nodiscard]] LabelSide clear_side(render::Float3 site, render::Float3 outward,
                                   const Viewer& viewer, LabelSide until_now);
[[nodiscard]] CrossPlaces places_of(const TargetCross& cross);

/// Rings carry `label`, the dots the next one.
void add_target_cross(render::Scene& scene, const TargetCross& cross, render::Label label);
/// The outermost ring of a drawn cross; absent: the scene shows none.
struct CrossDisc {
  render::Float3 middle;
  float radius_m = 0;
  const render::LineItem* ring = nullptr;  ///< never null
};
[[nodiscard]] std::optional<CrossDisc> disc_of(const render::Scene& scene, render::Label label);
/// Takes the dots off a drawn cross and says that the tool is lost.
void take_dots_off(render::Scene& scene, render::Label label);

/// From the angle's baseline down to the depth's, in cap heights of the depth.
inline constexpr float kDepthBelowAngle = 1.9f;
/// H9: `12.3 mm to entry`, `31.0 mm to target`, `1.2 mm past target`, under H6, which is beside `b`
/// (see `add_angle_readout`); paler and smaller with its SD if it is not sure, with a red rim past
/// the target.
void add_depth(render::Scene& scene, render::Float3 a, render::Float3 b,
               const nav::ShownDepth& depth, render::Label label);

}  // namespace orthonav::engine
