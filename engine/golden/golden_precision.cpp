#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/angle.h"
#include "engine/golden/golden_stage.h"
#include "engine/golden/golden_vertebra.h"
#include "engine/holograms/shapes/hologram_twin.h"
#include "render/float3.h"
#include "render/projection.h"

namespace orthonav::engine::golden {
namespace {

using render::Float3;

/// An offset from the planned axis, so far in that direction about it.
Float3 off_axis(float away_m, float about_deg) {
  const Float3 across = render::any_perpendicular(planned_direction());
  const Float3 up = render::cross(planned_direction(), across);
  const auto about = static_cast<float>(about_deg * kRadiansPerDegree);
  return away_m * (std::cos(about) * across + std::sin(about) * up);
}

TargetCross target(std::optional<CrossReading> reading, const Viewer& viewer) {
  TargetCross cross;
  cross.site = kSite;
  cross.outward = planned_direction();
  cross.viewer = viewer;
  cross.reading = reading;
  return cross;
}

GoldenScene cross_seen(const std::string& name, const std::string& what, const TargetCross& cross) {
  const Float3 middle = places_of(cross).middle;
  GoldenScene golden = start(
      name, what, {render::look_at(cross.viewer.eye, middle, cross.viewer.up, 0.100f, 0.065f)});
  add_target_cross(golden.scene, cross, kCrossLabel);
  if (!cross.reading || cross.reading->grade == Grade::kGood) {  // dashes are not alike all around
    golden.centred = {{kCrossLabel, middle}};
  }
  if (cross.reading) {
    golden.covered = {{kCrossDotLabel, places_of(cross).dots[0]}};
  }
  return golden;
}

GoldenScene cross(const std::string& name, const std::string& what, float tip_m, float top_m,
                  float roll_deg = 0.0f) {
  const Grade grade = grade_of(std::atan(std::abs(top_m - tip_m) / 0.080f));
  const bool tip = tip_m > 0.002f;
  const Worst worst = grade == Grade::kGood && !tip ? Worst::kNothing
                      : tip                         ? Worst::kOffset
                                                    : Worst::kAngle;
  const CrossReading reading{off_axis(tip_m, 200.0f), off_axis(top_m, 120.0f), grade, worst};
  const Viewer viewer = surgeon(0.4263f, roll_deg);
  return cross_seen(name, what, target(reading, viewer));
}

GoldenScene empty_cross(const std::string& name, const std::string& what, bool lost) {
  TargetCross cross = target(std::nullopt, surgeon());
  cross.lost = lost;
  return cross_seen(name, what, cross);
}

GoldenScene twin(const std::string& name, const std::string& what, bool with_tool) {
  const VirtualTwin twin{kSite, {-1, 0, 0}};
  const Float3 looked = in_twin(twin, {0, 0.03f, 0});
  const Float3 eye = surgeon().eye;
  GoldenScene golden =
      start_wide(name, what, {render::look_at(eye, looked, surgeon().up, 0.50f, 0.325f)});
  render::Scene parts;
  add_vertebra(parts, make_golden_vertebra(), render::kIdentity, kTwinLabel);
  add_planned_trajectory(parts, kEntry, kTarget, kTwinLabel);
  add_twin(golden.scene, twin, parts, kTwinLabel);
  golden.covered = {{kTwinLabel, in_twin(twin, kEntry)}};
  if (!with_tool) {
    return golden;
  }
  parts = {};
  const Float3 b = tool_point(6.0);
  add_deviation_triangle(parts, kEntry, b, planned_point(), Grade::kPoor, kTwinToolLabel);
  add_tool(parts, kEntry, b - kEntry, kTwinToolLabel);
  add_twin(golden.scene, twin, parts, kTwinToolLabel);
  golden.covered.push_back({kTwinToolLabel, in_twin(twin, b)});
  return golden;
}

}  // namespace

void add_precision_scenes(std::vector<GoldenScene>& scenes) {
  scenes.push_back(cross("h7_aligned", "both dots in the inner ring, green", 0.0004f, 0.0009f));
  scenes.push_back(cross("h7_near", "both dots about the middle ring, green", 0.0018f, 0.0022f));
  scenes.push_back(cross(
      "h7_amber", "dot inside, hollow dot near the outer ring, amber, an arrow from it to the dot",
      0.0014f, 0.0048f));
  scenes.push_back(cross("h7_outside",
                         "both dots at the rim, red, an arrow from the filled one inwards", 0.0085f,
                         0.0180f));
  scenes.push_back(
      cross("h7_rolled_left", "as amber, the head rolled to the left", 0.0014f, 0.0048f, -20.0f));
  scenes.push_back(
      cross("h7_rolled_right", "as amber, the head rolled to the right", 0.0014f, 0.0048f, 20.0f));
  scenes.push_back(empty_cross("h7_empty", "rings without dots", false));
  scenes.push_back(empty_cross("h7_lost", "the outer ring, tool lost written across it", true));
  scenes.push_back(twin("h8_twin", "vertebra and plan, twice as large", false));
  scenes.push_back(twin("h8_twin_tool", "the same with triangle and a white tool", true));
}

}  // namespace orthonav::engine::golden
