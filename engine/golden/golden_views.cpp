#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/check.h"
#include "engine/golden/golden_stage.h"
#include "engine/golden/golden_vertebra.h"
#include "engine/holograms/gaze_anchor.h"
#include "engine/holograms/hologram_numbers.h"
#include "engine/holograms/render_values.h"
#include "render/float3.h"

namespace orthonav::engine::golden {
namespace {

using render::Float3;

/// Takes the cross and its numbers off, which face the eyes from where they were.
void take_cross_off(render::Scene& scene) {
  const auto of_cross = [](const auto& item) {
    return kind_of(item.label) == HologramKind::kCross || item.label == kNumbersLabel ||
           item.label == kClearanceLabel;
  };
  scene.meshes.erase_if(of_cross);
  scene.lines.erase_if(of_cross);
  scene.texts.erase_if(of_cross);
}

/// Hangs both beside another place, or for other eyes.
TargetCross hang_cross(GoldenScene& golden, Float3 site, const Viewer& viewer,
                       const CrossReading& reading) {
  take_cross_off(golden.scene);
  TargetCross cross;
  cross.site = site;
  cross.outward = planned_direction();
  cross.viewer = viewer;
  cross.reading = reading;
  add_target_cross(golden.scene, cross, kCrossLabel);
  add_numbers(golden.scene, cross, numbers_of(guided(3.4, 0.0006, -0.0062), {}), false,
              kNumbersLabel);
  add_clearance(golden.scene, cross, kClearance, kClearanceLabel);
  return cross;
}

GoldenScene seen_from(float distance_m, float roll_deg, const std::string& rolled) {
  GoldenScene golden = guidance_scene();
  const auto cm = std::to_string(std::lround(100.0f * distance_m));
  golden.name = "guidance_" + cm + "cm_" + rolled;
  golden.what =
      "guidance from " + cm + " cm, head " + rolled + ": texts upright to the head, both eyes";
  golden.views = surgeon_views(distance_m, roll_deg);
  hang_cross(golden, kSite, surgeon(distance_m, roll_deg),
             CrossReading{{0.0005f, 0, 0.0004f}, {0.004f, 0, -0.002f}, Grade::kFair});
  return golden;
}

/// A head that looks at the site from where the viewer is.
Transform<World, Rig> head_of(const Viewer& viewer) {
  const Vec3 back = to_vec3(viewer.eye - kSite).normalized();
  const Vec3 right = to_vec3(viewer.up).cross(back).normalized();
  const Vec3 up = back.cross(right);
  return {Mat3{{{{right.x, up.x, back.x}, {right.y, up.y, back.y}, {right.z, up.z, back.z}}}},
          to_vec3(viewer.eye)};
}

/// From the site to where the cross hangs once the eyes have rested on a place.
Float3 aside_for_eyes_on(Float3 place, const Viewer& viewer) {
  LevelState level;
  level.plan.screws = {plan_of(Side::kLeft), plan_of(Side::kRight)};
  const std::array<PlacedLevel, 1> entries_of = {{{&level, {}}}};
  const GazeAnchor::Hanging hanging{
      {to_vec3(kSite)}, {}, head_of(viewer), LabelSide::kLeft, entries_of};
  const Vec3 eye = to_vec3(viewer.eye);
  const Vec3 towards = (to_vec3(place) - eye).normalized();
  constexpr Duration kEvery = std::chrono::milliseconds(25);
  GazeAnchor anchor;
  std::optional<Direction<Vertebra>> aside;
  for (Timestamp at{}; at <= Timestamp{GazeAnchor::kRests}; at += kEvery) {
    aside = anchor.follow(hanging, Gaze{{eye}, {towards}, at}, at);
  }
  ORTHONAV_CHECK(aside);
  return to_float3(aside->v);
}

/// As `guidance`, but the eyes have rested on a lower facet, and the cross hangs beside that.
GoldenScene gazed_at() {
  GoldenScene golden = guidance_scene();
  golden.name = "guidance_gaze";
  golden.what =
      "guidance, the cross lower: beside the left lower facet, where the eyes rest, both eyes";
  const nav::ScrewGuidance tool = guided(3.4, 0.0006, -0.0062);
  const Float3 looked_at = on_golden_vertebra(0.012f, -0.020f);
  const TargetCross cross =
      hang_cross(golden, kSite + aside_for_eyes_on(looked_at, surgeon()), surgeon(),
                 CrossReading{to_float3(tool.tip_offset_m), to_float3(tool.top_offset_m),
                              grade_of(tool.angle_rad)});
  golden.covered.push_back({kCrossDotLabel, places_of(cross).dots[0]});
  golden.centred = {{kCrossLabel, places_of(cross).middle}};
  return golden;
}

}  // namespace

void add_view_scenes(std::vector<GoldenScene>& scenes) {
  for (const float distance_m : {0.35f, 0.50f, 0.70f}) {
    scenes.push_back(seen_from(distance_m, -20.0f, "rolled_left"));
    scenes.push_back(seen_from(distance_m, 0.0f, "upright"));
    scenes.push_back(seen_from(distance_m, 20.0f, "rolled_right"));
  }
  scenes.push_back(gazed_at());
}

}  // namespace orthonav::engine::golden
