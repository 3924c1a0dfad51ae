#include <array>

#include "engine/golden/golden_stage.h"
#include "engine/golden/golden_vertebra.h"
#include "engine/holograms/hologram_numbers.h"
#include "engine/holograms/render_values.h"
#include "engine/session/wording.h"
#include "render/float3.h"

namespace orthonav::engine::golden {
namespace {

using render::Float3;

// The steps that the scenes show.
const StepOnDisplay kSetup{Step::kSetup, {}, {}};
const StepOnDisplay kDigitize{Step::kDigitize, "L4", {}};
const StepOnDisplay kVerify{Step::kVerify, "L4", {}};
const StepOnDisplay kAccepted{Step::kAccepted, "L4", {}};
const StepOnDisplay kGuide{Step::kGuide, "L4", Side::kLeft};
const StepOnDisplay kGuideNext{Step::kGuide, "L5", Side::kLeft};

/// `detail` is the text after the step on the status line; may be empty.
GoldenScene step(const std::string& name, const std::string& what, const StepOnDisplay& at,
                 const std::string& detail, ToolState tool = ToolState::kMeasured) {
  GoldenScene golden = start_wide(name, what + ", both eyes", surgeon_views());
  const bool pointer = at.step == Step::kDigitize || at.step == Step::kVerify;
  const std::string status = step_text(at) + (detail.empty() ? "" : " | " + detail);
  const std::array<ToolDot, 2> tools = {
      {{pointer ? "pointer" : "guide", tool}, {"reference", ToolState::kPredicted}}};
  add_status_line(golden.scene, status, tools, kStatusLabel);
  return golden;
}

void add_paths(GoldenScene& golden, bool recording) {
  const std::vector<Float3> saved = stroke();
  add_sampled_path(golden.scene, saved, PathState::kSaved, kPathLabel);
  golden.covered.push_back({kPathLabel, saved.front()});
  if (!recording) {
    return;
  }
  std::vector<Float3> recorded = stroke(Side::kLeft);
  recorded.resize(70);
  add_sampled_path(golden.scene, recorded, PathState::kRecording, kOtherPathLabel);
  golden.covered.push_back({kOtherPathLabel, recorded.back()});
}

void add_bone(GoldenScene& golden) {
  add_vertebra(golden.scene, make_golden_vertebra(), render::kIdentity, kVertebraLabel);
}

void add_entries(GoldenScene& golden, bool left_done, bool right_done) {
  add_entry(golden.scene, {kEntry, kNormal, "L4 left", left_done, LabelSide::kLeft}, kEntryLabel);
  add_entry(golden.scene, {kOtherEntry, kOtherNormal, "L4 right", right_done, LabelSide::kRight},
            kOtherEntryLabel);
  golden.covered.push_back({kOtherEntryLabel, kOtherEntry});
}

/// Everything that does not depend on the tool.
GoldenScene guiding(const std::string& name, const std::string& what, const std::string& detail,
                    ToolState tool = ToolState::kMeasured) {
  GoldenScene golden = step(name, what, kGuide, detail, tool);
  add_entries(golden, false, true);
  add_planned_trajectory(golden.scene, kEntry, kTarget, kTrajectoryLabel);
  return golden;
}

TargetCross add_cross_to(GoldenScene& golden, std::optional<CrossReading> reading, bool lost) {
  TargetCross cross;
  cross.site = kSite;
  cross.outward = planned_direction();
  cross.viewer = surgeon();
  cross.reading = reading;
  cross.lost = lost;
  add_target_cross(golden.scene, cross, kCrossLabel);
  return cross;
}

/// The guide at an angle, its tip beside the entry.
void add_tool_to(GoldenScene& golden, const nav::ScrewGuidance& guide, bool measured) {
  const Float3 b = to_float3(guide.b.v);
  const double angle_rad = guide.angle_rad;
  const Grade grade = measured ? grade_of(angle_rad) : Grade::kFair;
  add_deviation_triangle(golden.scene, kEntry, b, planned_point(), grade, kTriangleLabel);
  add_angle_readout(golden.scene, kEntry, b,
                    angle_text(measured ? std::optional(angle_rad) : std::nullopt),
                    measured ? grade : Grade::kPoor, kAngleLabel);
  golden.covered.push_back({kTriangleLabel, b});
  golden.covered.push_back({kTriangleLabel, planned_point()});
  if (!measured) {
    add_cross_to(golden, std::nullopt, false);
    return;
  }
  const TargetCross cross = add_cross_to(
      golden, CrossReading{to_float3(guide.tip_offset_m), to_float3(guide.top_offset_m), grade},
      false);
  const nav::ScrewNumbers numbers = numbers_of(guide, {});
  add_numbers(golden.scene, cross, numbers, false, kNumbersLabel);
  add_clearance(golden.scene, cross, kClearance, kClearanceLabel);
  std::string row;
  append_numbers(row, numbers, false);
  add_row_above_status(golden.scene, row, kNumbersRowLabel);
  add_depth(golden.scene, kEntry, b, shown_depth(guide.depth_m, guide.to_target_m), kDepthLabel);
}

GoldenScene digitizing() {
  GoldenScene golden =
      step("digitizing", "orange saved path, yellow one being recorded", kDigitize, "812 points");
  add_paths(golden, true);
  return golden;
}

GoldenScene refused() {
  GoldenScene golden = step("digitize_refused", "orange path, the reason in the status line",
                            kDigitize, "refused: error expected 2.3 mm; digitize the left facet");
  add_paths(golden, false);
  return golden;
}

GoldenScene verifying() {
  GoldenScene golden = step("verify", "the vertebra, its path by distance, three cyan diamonds",
                            kVerify, "RMSE 0.62 mm | touch 3 places, 15 mm apart");
  add_bone(golden);
  const std::vector<Float3> samples = stroke();
  std::vector<float> distances_m(samples.size(), 0.0004f);
  for (std::size_t i = 50; i < 70; ++i) {
    distances_m[i] = 0.0016f;
  }
  add_residual_path(golden.scene, samples, distances_m, kPathLabel, kPathBehindChecks);
  std::size_t k = 0;
  for (const Float3 place : kPlacesToCheck) {
    add_place_to_check(golden.scene, place, label_of(HologramKind::kCheckPoint, ++k));
  }
  return golden;
}

GoldenScene checked() {
  GoldenScene golden = step("verify_checked", "the vertebra, two green places, a red one", kVerify,
                            "check point 3 is 3.1 mm off, limit 2.0 mm");
  add_bone(golden);
  constexpr std::array<double, 3> kDistances_m = {0.0004, 0.0011, 0.0031};
  std::size_t k = 0;
  for (std::size_t i = 0; i < kPlacesToCheck.size(); ++i) {
    add_check_point(golden.scene, kPlacesToCheck[i], distance_text(kDistances_m[i]),
                    kDistances_m[i] <= 0.002, label_of(HologramKind::kCheckPoint, ++k));
  }
  return golden;
}

GoldenScene checked_often() {
  GoldenScene golden = step("verify_many", "the vertebra, small dim places and a green one at last",
                            kVerify, "check 13: 0.4 mm; passed, worst 1.1 mm");
  add_bone(golden);
  std::size_t k = 0;
  for (std::size_t i = 0; i < kPlacesToCheck.size(); ++i) {
    const Float3 place = kPlacesToCheck[i];
    const Float3 next = kPlacesToCheck[(i + 1) % kPlacesToCheck.size()];
    for (const float part : {0.0f, 0.14f, 0.28f, 0.42f}) {
      add_earlier_check_point(golden.scene, place + part * (next - place),
                              label_of(HologramKind::kCheckPoint, ++k));
    }
  }
  add_check_point(golden.scene, 0.5f * (kPlacesToCheck[1] + kPlacesToCheck[2]),
                  distance_text(0.0004), true, label_of(HologramKind::kCheckPoint, ++k));
  return golden;
}

GoldenScene accepted() {
  GoldenScene golden =
      step("accepted", "two blue entries, nothing else", kAccepted, "RMSE 0.62 mm");
  add_entries(golden, false, false);
  return golden;
}

GoldenScene guide_far() {
  GoldenScene golden = guiding("guide_far", "plan and cross with arrows: the tool is far away",
                               "RMSE 0.62 mm | predicted 1.1 mm");
  add_cross_to(golden, CrossReading{{0.03f, 0, 0.02f}, {0.04f, 0, 0.02f}, Grade::kPoor}, false);
  return golden;
}

GoldenScene guide_beside() {
  GoldenScene golden =
      guiding("guide_beside", "parallel, 3 mm beside the entry: green number, open triangle",
              "RMSE 0.62 mm | predicted 1.1 mm");
  add_tool_to(golden, guided(0.4, 0.0030, -0.0021), true);
  return golden;
}

GoldenScene guide_drilling() {
  GoldenScene golden = guiding("guide_drilling", "green triangle and dots, depth to the target",
                               "RMSE 0.62 mm | predicted 1.1 mm");
  add_tool_to(golden, guided(0.8, 0.0001, 0.0140), true);
  return golden;
}

GoldenScene guide_predicted() {
  GoldenScene golden = guiding("guide_predicted", "amber triangle, dashes, rings without dots",
                               "RMSE 0.62 mm | predicted 1.1 mm", ToolState::kPredicted);
  add_tool_to(golden, guided(1.0, 0.0, 0.0), false);
  return golden;
}

GoldenScene guide_lost() {
  GoldenScene golden = guiding("guide_lost", "plan, dashes, tool lost across the rings",
                               "guide not seen", ToolState::kLost);
  add_angle_readout(golden.scene, kEntry, trajectory_outer_end(kEntry, kTarget),
                    angle_text(std::nullopt), Grade::kPoor, kAngleLabel);
  add_cross_to(golden, std::nullopt, true);
  return golden;
}

GoldenScene screws_done() {
  GoldenScene golden = step("guide_done", "two entries with ticks", kGuideNext, "say start");
  add_entries(golden, true, true);
  return golden;
}

}  // namespace

GoldenScene guidance_scene() {
  GoldenScene golden =
      guiding("guidance", "guiding the left screw of L4 with everything, the right one done",
              "RMSE 0.62 mm | predicted 1.1 mm");
  add_bone(golden);
  add_tool_to(golden, guided(3.4, 0.0006, -0.0062), true);
  return golden;
}

void add_step_scenes(std::vector<GoldenScene>& scenes) {
  scenes.push_back(step("setup", "the status line alone", kSetup, "", ToolState::kLost));
  scenes.push_back(digitizing());
  scenes.push_back(refused());
  scenes.push_back(verifying());
  scenes.push_back(checked());
  scenes.push_back(checked_often());
  scenes.push_back(accepted());
  scenes.push_back(guide_far());
  scenes.push_back(guidance_scene());
  scenes.push_back(guide_beside());
  scenes.push_back(guide_drilling());
  scenes.push_back(guide_predicted());
  scenes.push_back(guide_lost());
  scenes.push_back(screws_done());
}

}  // namespace orthonav::engine::golden
