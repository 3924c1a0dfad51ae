#include <array>
#include <utility>

#include "engine/golden/golden_stage.h"
#include "engine/holograms/hologram_numbers.h"
#include "render/float3.h"
#include "render/projection.h"

namespace orthonav::engine::golden {
namespace {

using render::Float3;

constexpr render::Label kPaperLabel = 9001;  // belongs to no hologram
constexpr std::array<ToolDot, 2> kToolDots = {
    {{"guide", ToolState::kMeasured}, {"reference", ToolState::kPredicted}}};

void add_names(GoldenScene& golden, const std::string& level, Float3 offset, render::Label label) {
  const auto add = [&](Float3 place, Float3 normal, const char* side, bool done, LabelSide beside) {
    const std::string name = level + side;
    add_entry(golden.scene, {place + offset, normal, name, done, beside}, label);
    golden.covered.push_back({label++, place + offset});
  };
  add(kEntry, kNormal, " left", true, LabelSide::kLeft);
  add(kOtherEntry, kOtherNormal, " right", true, LabelSide::kRight);
}

/// Three levels from the patient's side: names lay over each other's entries.
GoldenScene names() {
  GoldenScene golden =
      start_wide("labels_names", "six names, none over another or over an entry",
                 render::stereo_pair(render::look_at({-0.36f, 0.20f, -0.06f}, {0, 0.03f, 0},
                                                     {0, 1, 0}, 0.394f, 0.2561f)));
  add_names(golden, "L3", {0, 0, 0.034f}, kEntryLabel);
  add_names(golden, "L4", {0, 0, 0}, kEntryLabel + 2);
  add_names(golden, "L5", {0, -0.003f, -0.034f}, kEntryLabel + 4);
  add_status_line(golden.scene, "accepted L4 | RMSE 0.62 mm", kToolDots, kStatusLabel);
  return golden;
}

/// A tag begins where the angle would be.
GoldenScene off_the_tag() {
  GoldenScene golden = start_wide(
      "labels_off_tag", "angle and depth beside a tag's outline, not on it", surgeon_views());
  const Float3 b = tool_point(3.4);
  const Float3 along = render::unit_or(b - kEntry, {});
  const Float3 across = render::unit_or(render::cross(along, {0.45f, 0.3f, -0.5f}), {});
  const Float3 low = b + -0.002f * along;
  golden.papers = {{low + -0.026f * across, low + 0.026f * across,
                    low + 0.026f * across + 0.036f * along,
                    low + -0.026f * across + 0.036f * along}};
  render::LineItem outline;
  outline.label = kPaperLabel;
  outline.points.assign(golden.papers[0].begin(), golden.papers[0].end());
  outline.closed = true;
  golden.scene.lines.push_back(outline);
  add_entry(golden.scene, {kEntry, kNormal, "L4 left", false, LabelSide::kLeft}, kEntryLabel);
  add_planned_trajectory(golden.scene, kEntry, kTarget, kTrajectoryLabel);
  add_deviation_triangle(golden.scene, kEntry, b, planned_point(), Grade::kFair, kTriangleLabel);
  add_angle_readout(golden.scene, kEntry, b, "3.4°", Grade::kFair, kAngleLabel);
  add_depth(golden.scene, kEntry, b, shown_depth(-0.0062, 0.0512), kDepthLabel);
  add_status_line(golden.scene, "guide L4 left | RMSE 0.62 mm", kToolDots, kStatusLabel);
  golden.covered = {{kEntryLabel, kEntry}};
  return golden;
}

/// A rod so low in view that its length was written over the status line.
GoldenScene rod_length() {
  GoldenScene golden =
      start_wide("labels_rod", "the length beside the rod's end, not on the status line",
                 render::stereo_pair(render::look_at({0.02f, 0.42f, 0.06f}, {0.02f, 0.04f, 0.093f},
                                                     {0, 0.3f, 1}, 0.394f, 0.2561f)));
  constexpr std::array<Float3, 2> kHeads = {{{0.021f, 0.046f, 0.061f}, {0.020f, 0.045f, 0.033f}}};
  RodHologram rod;
  rod.heads = kHeads;
  rod.length_m = 0.0283;
  add_rod(golden.scene, rod, kRodLabel);
  for (const Float3 head : kHeads) {
    golden.covered.push_back({kRodLabel, head});
  }
  add_status_line(golden.scene, "rod right | 2 heads", kToolDots, kStatusLabel);
  return golden;
}

/// A site so low in view that the lowest numbers lay over the row above the status line.
GoldenScene numbers_low() {
  const Viewer viewer = surgeon();
  GoldenScene golden =
      start_wide("labels_numbers", "the numbers under the cross end above the status line's rows",
                 render::stereo_pair(render::look_at(viewer.eye, kEntry + 0.055f * viewer.up,
                                                     viewer.up, 0.394f, 0.2561f)));
  TargetCross cross;
  cross.site = kEntry;
  cross.outward = render::unit_or(kEntry - kTarget, {});
  cross.viewer = viewer;
  cross.side = LabelSide::kLeft;
  cross.reading = CrossReading{{0.0005f, 0, 0.0004f}, {0.004f, 0, -0.002f}, Grade::kFair};
  const nav::ScrewNumbers numbers = numbers_of(guided(3.4, 0.0006, -0.0062), {});
  nav::ShownClearance clearance;
  clearance.least_tenths = 25;
  clearance.lower_95_tenths = 6;
  add_entry(golden.scene, {kEntry, kNormal, "L4 left", false, LabelSide::kLeft}, kEntryLabel);
  add_planned_trajectory(golden.scene, kEntry, kTarget, kTrajectoryLabel);
  add_target_cross(golden.scene, cross, kCrossLabel);
  add_numbers(golden.scene, cross, numbers, false, kNumbersLabel, true);
  add_clearance(golden.scene, cross, clearance, kClearanceLabel);
  add_status_line(golden.scene, "guide L4 left | RMSE 0.62 mm", kToolDots, kStatusLabel);
  std::string row;
  append_numbers(row, numbers, false);
  add_row_above_status(golden.scene, row, kNumbersRowLabel);
  golden.covered = {{kEntryLabel, kEntry}};
  return golden;
}

}  // namespace

void add_label_scenes(std::vector<GoldenScene>& scenes) {
  scenes.push_back(names());
  scenes.push_back(off_the_tag());
  scenes.push_back(rod_length());
  scenes.push_back(numbers_low());
}

}  // namespace orthonav::engine::golden
