#include "engine/golden/golden_operation.h"

#include <chrono>
#include <utility>

#include "base/check.h"
#include "engine/golden/golden_vertebra.h"
#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/render_values.h"
#include "render/float3.h"

namespace orthonav::engine::golden {
namespace {

constexpr Timestamp kNow{std::chrono::seconds(10)};

std::shared_ptr<const nav::VertebraModel> golden_model() {
  static const auto kModel = [] {
    auto model = nav::VertebraModel::prepare(golden_mesh());
    ORTHONAV_CHECK(model.ok());
    return *std::move(model);
  }();
  return kModel;
}

/// A head that looks at the site from where the viewer is.
Transform<World, Rig> head_of(const Viewer& viewer) {
  const Vec3 back = to_vec3(viewer.eye - kSite).normalized();
  const Vec3 right = to_vec3(viewer.up).cross(back).normalized();
  return {Mat3::from_columns(right, back.cross(right), back), to_vec3(viewer.eye)};
}

}  // namespace

StagedOperation::StagedOperation(Step step) : levels_(1), tools_(2) {
  LevelState& level = levels_.front();
  level.plan.label = "L4";
  level.plan.model = golden_model();
  level.plan.screws = {plan_of(Side::kLeft), plan_of(Side::kRight)};
  level.registration.emplace();
  level.registration->common.tip_m = 0.0001;
  level.accepted = step >= Step::kTouchLandmark;
  level.screws.resize(2);
  level.screws[1].done = true;
  tools_[0] = {"guide", nav::ToolRole::kGuide, PoseStatus::kMeasured, {}};
  if (step == Step::kDigitize || step == Step::kVerify) {
    tools_[0] = {"pointer", nav::ToolRole::kPointer, PoseStatus::kMeasured, {}};
  }
  tools_[1] = {"reference", nav::ToolRole::kReference, PoseStatus::kMeasured, {}};
  const bool of_level = step != Step::kSetup && step != Step::kDone;
  const bool of_side = step == Step::kGuide || step == Step::kMeasureWire;
  guidance.step = step;
  guidance.status.at = {step, of_level ? "L4" : "",
                        of_side ? std::optional(Side::kLeft) : std::nullopt};
  guidance.frame_time = guidance.display_time = guidance.pose_time = kNow;
  guidance.stale_after = std::chrono::milliseconds(100);
  look_from(surgeon());
}

void StagedOperation::look_from(const Viewer& viewer) { guidance.head = head_of(viewer); }

void StagedOperation::measure(const nav::ScrewGuidance& tool, const NumberSds& sds) {
  ToolGuidance& shown = guidance.tool.emplace();
  shown.measured = shown.shown = tool;
  shown.pose_time = kNow;
  shown.numbers = numbers_of(tool, sds);
  shown.sizes = sizes_of(tool, sds);
  shown.depth = shown_depth(tool.depth_m, tool.to_target_m, sds.translation_m);
  shown.shown_clearance = kClearance;
}

void StagedOperation::predict(const nav::ScrewGuidance& tool) {
  ToolGuidance& shown = guidance.tool.emplace();
  shown.shown = tool;
  shown.pose_time = kNow;
  tools_[0].status = PoseStatus::kPredicted;
  guidance.drill = guidance.drill.unwatched();
}

void StagedOperation::lose() {
  guidance.tool.reset();
  guidance.drill = guidance.drill.unwatched();
  guidance.status.tool = "guide";
  guidance.status.tool_lost = true;
  tools_[0].status = PoseStatus::kLost;
}

GoldenScene StagedOperation::scene(const std::string& name, const std::string& what,
                                   std::vector<render::View> views) const {
  GoldenScene golden = start_wide(name, what + ", both eyes", std::move(views));
  Guidance all = guidance;
  all.levels = levels_;
  all.tools = tools_;
  all.regions = regions;
  all.residuals_m = residuals_m;
  all.to_check = to_check;
  SceneBuilder builder(rules);
  if (rests_on) {
    const Vec3 eye = guidance.head->translation();
    const Direction<World> towards{(to_vec3(*rests_on) - eye).normalized()};
    for (Timestamp at = kNow - GazeAnchor::kRests; at < kNow; at += std::chrono::milliseconds(25)) {
      builder.look_at(Gaze{{eye}, towards, at});
      builder.update(all, at);
    }
    builder.look_at(Gaze{{eye}, towards, kNow});
  }
  builder.update(all);
  builder.write_scene(all, golden.scene);
  return golden;
}

}  // namespace orthonav::engine::golden
