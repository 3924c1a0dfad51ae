#include "base/angle.h"
#include "engine/golden/golden_stage.h"
#include "engine/holograms/hologram_numbers.h"
#include "engine/holograms/render_values.h"
#include "engine/holograms/scene_builder.h"
#include "render/float3.h"
#include "render/projection.h"

namespace orthonav::engine::golden {
namespace {

using render::Float3;

/// A tool at a plan of either side, its tip off the entry towards the patient's head and left, its
/// shaft leaning as far.
nav::ScrewGuidance tool_at(Side side, Vec3 tip_off_m, Vec3 lean_rad) {
  const nav::ScrewPlan plan = plan_of(side);
  const Vec3 outward = (plan.entry - plan.target).normalized();
  return nav::guide({Mat3::identity(), {}}, plan, {plan.entry.v + tip_off_m},
                    rotation_from_vector(lean_rad) * outward);
}

TargetCross cross_with(const nav::ScrewGuidance& tool, LabelSide hangs) {
  TargetCross cross;
  cross.site = {0, 0.0320f, 0.0070f};
  cross.outward = to_float3((tool.c - tool.a).normalized());
  cross.viewer = surgeon();
  cross.side = hangs;
  cross.reading = CrossReading{to_float3(tool.tip_offset_m), to_float3(tool.top_offset_m),
                               grade_of(tool.angle_rad)};
  return cross;
}

GoldenScene captioned(const std::string& name, const std::string& what, const TargetCross& cross,
                      const nav::ScrewNumbers& numbers, bool registration_only) {
  constexpr float kCaption_m = 0.037f;
  const CrossPlaces places = places_of(cross);
  GoldenScene golden =
      start(name, what,
            {render::look_at(cross.viewer.eye, places.middle - kCaption_m * places.up,
                             cross.viewer.up, 0.216f, 0.1404f)});
  add_target_cross(golden.scene, cross, kCrossLabel);
  add_numbers(golden.scene, cross, numbers, registration_only, kNumbersLabel);
  golden.covered = {{kCrossDotLabel, places.dots[0]}};
  return golden;
}

// Towards the patient's head and left by 1.2 and 0.8 mm; aiming caudal and to the right.
constexpr Vec3 kTipOff_m{0.0008, 0.0, 0.0012};
constexpr Vec3 kLean_rad{0.036, 0.0, -0.021};

GoldenScene of_side(Side side, LabelSide hangs) {
  const bool left = side == Side::kLeft;
  const nav::ScrewGuidance tool = tool_at(side, kTipOff_m, kLean_rad);
  return captioned(left ? "h13_left" : "h13_right",
                   left ? "left screw: tip cranial and lateral, aims caudal and medial"
                        : "right screw, the tool off as before: tip medial, aims lateral",
                   cross_with(tool, hangs), numbers_of(tool, {}, side), false);
}

GoldenScene unsure(const std::string& name, const std::string& what, const NumberSds& sds,
                   bool registration_only) {
  const nav::ScrewGuidance tool = tool_at(Side::kLeft, kTipOff_m, kLean_rad);
  return captioned(name, what, cross_with(tool, LabelSide::kLeft), numbers_of(tool, sds),
                   registration_only);
}

GoldenScene on_plan() {
  const nav::ScrewGuidance tool = tool_at(Side::kLeft, {}, {});
  return captioned("h13_zero", "four zeros without a direction, dots in the middle",
                   cross_with(tool, LabelSide::kLeft), numbers_of(tool, {}), false);
}

GoldenScene cleared(const std::string& name, const std::string& what,
                    const nav::ShownClearance& clearance) {
  const nav::ScrewGuidance tool = tool_at(Side::kLeft, kTipOff_m, kLean_rad);
  const TargetCross cross = cross_with(tool, LabelSide::kLeft);
  GoldenScene golden = captioned(name, what, cross, numbers_of(tool, {}), false);
  add_clearance(golden.scene, cross, clearance, kClearanceLabel);
  return golden;
}

/// The tool off the entry by so much towards the patient's left, aiming as planned.
GoldenScene drilled(const std::string& name, const std::string& what, double off_m,
                    nav::DrillAlarm alarm) {
  const nav::ScrewGuidance tool = tool_at(Side::kLeft, {off_m, 0.0, 0.0}, {});
  const TargetCross cross = cross_with(tool, LabelSide::kLeft);
  const bool stop = alarm == nav::DrillAlarm::kStop;
  GoldenScene golden = captioned(name, what, cross, numbers_of(tool, {}), false);
  add_drill(golden.scene, cross, {nav::DrillPhase::kDrilling, alarm, true},
            stop ? kStopLabel : kDrillLabel);
  return golden;
}

/// With a pose that is too old, only the stop remains.
GoldenScene stop_unseen() {
  GoldenScene golden = drilled("h13_stop_late", "tool lost in the outer ring, stop below it",
                               0.0002, nav::DrillAlarm::kStop);
  hide_tool_guidance(golden.scene);
  golden.covered.clear();
  return golden;
}

GoldenScene lost() {
  GoldenScene golden = of_side(Side::kLeft, LabelSide::kLeft);
  golden.name = "h13_lost";
  golden.what = "tool lost in the outer ring, no number left";
  add_row_above_status(golden.scene, "tip 1.2 mm cranial", kNumbersRowLabel);
  hide_tool_guidance(golden.scene);
  golden.covered.clear();
  return golden;
}

}  // namespace

void add_number_scenes(std::vector<GoldenScene>& scenes) {
  scenes.push_back(of_side(Side::kLeft, LabelSide::kLeft));
  scenes.push_back(of_side(Side::kRight, LabelSide::kRight));
  scenes.push_back(unsure("h13_unsure", "offsets smaller and with their SDs, angles as ever",
                          {0.0014, 0.005}, false));
  scenes.push_back(unsure("h13_all_unsure", "all four with SDs, of the registration only",
                          {0.0014, 0.031}, true));
  scenes.push_back(on_plan());
  scenes.push_back(cleared("h13_clearance", "clearance 2.4 mm, at least 1.1 mm below the numbers",
                           {24, 11, "medial"}));
  scenes.push_back(cleared("h13_may_break",
                           "clearance 0.4 mm, in a red rim: may break through medially",
                           {4, -7, "medial"}));
  scenes.push_back(cleared("h13_breaks", "clearance below zero, in a red rim: breaks through",
                           {-13, -24, "lateral"}));
  scenes.push_back(drilled("h13_drilling", "drilling, in white", 0.0003, nav::DrillAlarm::kNone));
  scenes.push_back(drilled("h13_drifting", "drilling: drifting, in an amber rim", 0.0014,
                           nav::DrillAlarm::kAmber));
  scenes.push_back(
      drilled("h13_off_plan", "drilling: off plan, in a red rim", 0.0026, nav::DrillAlarm::kRed));
  scenes.push_back(
      drilled("h13_stop", "stop, large and in a red rim", 0.0003, nav::DrillAlarm::kStop));
  scenes.push_back(stop_unseen());
  scenes.push_back(lost());
}

}  // namespace orthonav::engine::golden
