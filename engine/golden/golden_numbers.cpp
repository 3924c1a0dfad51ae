#include "base/angle.h"
#include "engine/golden/golden_operation.h"
#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/render_values.h"
#include "engine/holograms/shapes/screw_holograms.h"
#include "render/float3.h"
#include "render/projection.h"

namespace orthonav::engine::golden {
namespace {

using render::Float3;

/// A tool at the plan of the left screw, its tip off the entry towards the patient's head and left,
/// its shaft leaning as far.
nav::ScrewGuidance tool_at(Vec3 tip_off_m, Vec3 lean_rad) {
  const nav::ScrewPlan plan = plan_of(Side::kLeft);
  const Vec3 outward = (plan.entry - plan.target).normalized();
  return nav::guide({Mat3::identity(), {}}, plan, {plan.entry.v + tip_off_m},
                    rotation_from_vector(lean_rad) * outward);
}

constexpr Vec3 kTipOff_m{0.0003, 0.0, 0.0004};
constexpr Vec3 kLean_rad{0.012, 0.0, -0.008};

/// The cross and what is written about it, and nothing else, from near.
class NearCross {
 public:
  explicit NearCross(const nav::ScrewGuidance& tool, const NumberSds& sds = {})
      : staged(Step::kGuide) {
    staged.measure(tool, sds);
    staged.guidance.drill = {nav::DrillPhase::kSet, nav::DrillAlarm::kNone, true};
  }
  [[nodiscard]] GoldenScene scene(const std::string& name, const std::string& what,
                                  float wider = 1.0f) const {
    const float down_m = 0.020f * wider;
    const GoldenScene whole = staged.scene(name, what);
    const Viewer viewer = surgeon();
    const CrossDisc disc = disc_of(whole.scene, kCrossLabel).value();
    GoldenScene golden = start(name, what,
                               {render::look_at(viewer.eye, disc.middle - down_m * viewer.up,
                                                viewer.up, wider * 0.185f, wider * 0.12025f)});
    const auto of_cross = [](const auto& item) {
      const HologramKind kind = kind_of(item.label);
      return kind == HologramKind::kCross || kind == HologramKind::kAngle ||
             kind == HologramKind::kDepth || kind == HologramKind::kNumbers;
    };
    golden.scene = whole.scene;
    const auto beside = [&](const auto& item) { return !of_cross(item); };
    golden.scene.meshes.erase_if(beside);
    golden.scene.lines.erase_if(beside);
    golden.scene.triangles.erase_if(beside);
    golden.scene.texts.erase_if([&](const render::TextItem& item) {
      return beside(item) || item.place == render::TextPlace::kView;
    });
    return golden;
  }
  StagedOperation staged;
};

GoldenScene numbers(const std::string& name, const std::string& what,
                    const nav::ScrewGuidance& tool, const NumberSds& sds = {}) {
  return NearCross(tool, sds).scene(name, what);
}

GoldenScene cleared(const std::string& name, const std::string& what,
                    const nav::ShownClearance& clearance) {
  NearCross near(tool_at(kTipOff_m, kLean_rad));
  near.staged.guidance.tool->shown_clearance = clearance;
  return near.scene(name, what);
}

GoldenScene unknown() {
  NearCross near(tool_at(kTipOff_m, kLean_rad));
  ToolGuidance& tool = *near.staged.guidance.tool;
  tool.sizes->angle.certainty = tool.sizes->offset.certainty = nav::Certainty::kUnknown;
  tool.depth->certainty = nav::Certainty::kUnknown;
  return near.scene("h6_unknown", "three numbers with question marks in amber rims");
}

/// With a pose that is too old, only the stop remains.
GoldenScene stop_late() {
  NearCross near(tool_at(kTipOff_m, kLean_rad));
  near.staged.guidance.drill = {nav::DrillPhase::kDrilling, nav::DrillAlarm::kStop, true};
  GoldenScene golden = near.scene("h13_stop_late", "stop, tool lost in the ring, dashes");
  hide_tool_guidance(golden.scene);
  return golden;
}

GoldenScene panel(const std::string& name, const std::string& what, const NumberSds& sds) {
  NearCross near(tool_at(kTipOff_m, kLean_rad), sds);
  near.staged.guidance.asked.numbers = true;
  return near.scene(name, what, 1.7f);
}

}  // namespace

void add_number_scenes(std::vector<GoldenScene>& scenes) {
  scenes.push_back(numbers("h6_good", "angle, offset and depth in white, all green",
                           tool_at(kTipOff_m, kLean_rad)));
  scenes.push_back(numbers("h6_angle", "the angle in an amber rim, an arrow from ring to dot",
                           tool_at(kTipOff_m, {0.05, 0.0, -0.02})));
  scenes.push_back(numbers("h6_offset", "the offset in a red rim, an arrow to the middle",
                           tool_at({0.0018, 0.0, 0.0016}, kLean_rad)));
  scenes.push_back(numbers("h6_bounds", "three bounds in amber rims: ≤, ≤, ≥",
                           tool_at(kTipOff_m, kLean_rad), {0.0014, 0.031}));
  scenes.push_back(unknown());
  scenes.push_back(numbers("h9_past_target", "the depth past the target in a red rim, a full bar",
                           guided(0.5, 0.0002, 0.0456)));
  scenes.push_back(cleared("h13_may_break", "may break through medially, amber, above the rings",
                           {4, -7, "medial"}));
  scenes.push_back(cleared("h13_breaks", "breaks through laterally, red", {-13, -24, "lateral"}));
  scenes.push_back(stop_late());
  scenes.push_back(panel("h13_panel", "below the three numbers four more and the clearance", {}));
  scenes.push_back(
      panel("h13_panel_unsure", "the same with SDs, smaller and paler", {0.0014, 0.031}));
}

}  // namespace orthonav::engine::golden
