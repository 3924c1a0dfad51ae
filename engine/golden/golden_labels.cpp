#include <array>
#include <cmath>

#include "base/angle.h"
#include "engine/golden/golden_operation.h"
#include "render/float3.h"
#include "render/projection.h"

namespace orthonav::engine::golden {
namespace {

using render::Float3;

constexpr render::Label kPaperLabel = 9001;  // belongs to no hologram
constexpr std::array<ToolDot, 2> kToolDots = {{{ToolState::kMeasured}, {ToolState::kPredicted}}};

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
  add_status_line(golden.scene, "landmark L4 | touch it", kToolDots, kStatusLabel);
  return golden;
}

/// Guiding, with both eyes turned from the site by so much: to the right and up, degrees.
GoldenScene turned(const std::string& name, const std::string& what, float right_deg,
                   float up_deg) {
  StagedOperation s(Step::kGuide);
  s.measure(guided(3.4, 0.0006, -0.0062));
  const Viewer viewer = surgeon();
  const float distance_m = render::length(kSite - viewer.eye);
  const Float3 back = render::unit_or(viewer.eye - kSite, {});
  const Float3 right = render::cross(viewer.up, back);
  const auto tan_of = [&](float deg) {
    return distance_m * std::tan(deg * static_cast<float>(kRadiansPerDegree));
  };
  return s.scene(name, what,
                 render::stereo_pair(render::look_at(
                     viewer.eye, kSite + tan_of(right_deg) * right + tan_of(up_deg) * viewer.up,
                     viewer.up, 0.394f, 0.2561f)));
}

/// A tag's paper with its outline: half its width and half its height about the middle.
void lay_paper(GoldenScene& golden, Float3 middle, Float3 across, Float3 along) {
  golden.papers = {{middle + -1.0f * across + -1.0f * along, middle + across + -1.0f * along,
                    middle + across + along, middle + -1.0f * across + along}};
  render::LineItem outline;
  outline.label = kPaperLabel;
  outline.points.assign(golden.papers[0].begin(), golden.papers[0].end());
  outline.closed = true;
  golden.scene.lines.push_back(outline);
}

/// A tag's paper where the cross would hang.
GoldenScene off_the_tag() {
  StagedOperation s(Step::kGuide);
  s.measure(guided(3.4, 0.0006, -0.0062));
  GoldenScene golden =
      s.scene("labels_off_tag", "the cross beside a tag's outline, nothing of it on the tag");
  const Float3 middle = disc_of(golden.scene, kCrossLabel)->middle;
  lay_paper(golden, middle, {0.040f, 0, 0}, {0, 0, 0.045f});
  return golden;
}

/// The reference's tag low in view, where the status line hangs.
GoldenScene status_off_the_tag() {
  StagedOperation s(Step::kGuide);
  s.measure(guided(0.8, 0.0004, 0.0002));
  s.guidance.drill = {nav::DrillPhase::kSet, nav::DrillAlarm::kNone, true};
  GoldenScene golden = s.scene("labels_status_off_tag",
                               "the status line beside a tag's outline, nothing of it on the tag");
  const render::Head head = render::head_of(golden.views);
  constexpr float kNearer = 0.85f;  // than the status line
  const Float3 middle =
      head.position + kNearer * (kStatusPlace.y * head.up + kStatusPlace.z * head.back);
  lay_paper(golden, middle, 0.030f * head.right, 0.024f * head.up);
  return golden;
}

/// The eyes rest so that the cross would hang over the planned trajectory.
GoldenScene off_the_trajectory() {
  StagedOperation s(Step::kGuide);
  s.measure(guided(3.4, 0.0006, -0.0062));
  const Viewer viewer = surgeon();
  const Float3 back = render::unit_or(viewer.eye - kSite, {});
  s.rests_on = kSite + 0.022f * render::cross(viewer.up, back) + -0.030f * viewer.up;
  return s.scene("labels_off_trajectory", "the cross beside the trajectory, nothing of it on that");
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
  add_status_line(golden.scene, "rod right | touch the next head", kToolDots, kStatusLabel);
  return golden;
}

}  // namespace

void add_label_scenes(std::vector<GoldenScene>& scenes) {
  scenes.push_back(names());
  scenes.push_back(off_the_tag());
  scenes.push_back(status_off_the_tag());
  scenes.push_back(off_the_trajectory());
  scenes.push_back(turned("labels_left_edge", "the site at the left edge, the cross whole", 13, 0));
  scenes.push_back(
      turned("labels_right_edge", "the site at the right edge, the cross whole", -14, 0));
  scenes.push_back(turned("labels_low", "the site low, the cross above the status line", 0, 9));
  scenes.push_back(rod_length());
}

}  // namespace orthonav::engine::golden
