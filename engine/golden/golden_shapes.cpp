#include "engine/golden/golden_stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "base/angle.h"
#include "engine/golden/golden_vertebra.h"
#include "engine/holograms/shapes/render_values.h"
#include "render/float3.h"
#include "render/projection.h"
#include "render/shapes.h"

namespace orthonav::engine::golden {
namespace {

using render::Float3;

GoldenScene path(const std::string& name, const std::string& what, PathState state) {
  GoldenScene golden = start(name, what, close_view({-0.011f, 0.033f, -0.004f}));
  const std::vector<Float3> samples = stroke();
  add_sampled_path(golden.scene, samples, state, kPathLabel);
  golden.covered = {
      {kPathLabel, samples.front()}, {kPathLabel, samples[60]}, {kPathLabel, samples.back()}};
  return golden;
}

GoldenScene fading(float opacity) {
  GoldenScene golden = start("h1_fading", "orange ribbon, half gone: a deleted region",
                             close_view({-0.011f, 0.033f, -0.004f}));
  const std::vector<Float3> samples = stroke();
  add_sampled_path(golden.scene, samples, PathState::kSaved, kPathLabel, opacity);
  golden.covered = {{kPathLabel, samples[60]}};
  return golden;
}

GoldenScene residuals() {
  GoldenScene golden = start("h1_residuals", "ribbon green, amber and red by its distance",
                             close_view({-0.011f, 0.033f, -0.004f}));
  const std::vector<Float3> samples = stroke();
  std::vector<float> distances_m;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    distances_m.push_back(0.0015f + 0.0014f * std::sin(0.13f * static_cast<float>(i)));
  }
  add_residual_path(golden.scene, samples, distances_m, kPathLabel);
  golden.covered = {{kPathLabel, samples.front()}, {kPathLabel, samples[60]}};
  return golden;
}

GoldenScene vertebra() {
  GoldenScene golden = start("h2_vertebra", "a vertebra: bright rim, dark see-through inside",
                             close_view({0, 0.02f, 0}));
  add_vertebra(golden.scene, make_golden_vertebra(), render::kIdentity, kVertebraLabel);
  golden.covered = {{kVertebraLabel, {-0.0010f, 0.0570f, -0.0120f}},
                    {kVertebraLabel, {0.0360f, 0.0285f, 0.0070f}},
                    {kVertebraLabel, {-0.0360f, 0.0276f, 0.0075f}},
                    {kVertebraLabel, {0.0163f, 0.0285f, 0.0245f}}};
  return golden;
}

GoldenScene bare_vertebra() {
  GoldenScene golden = start("h2_bare", "the same, bluish on the right, where no stroke came near",
                             close_view({0, 0.02f, 0}));
  auto partly = std::make_shared<render::MeshData>(*make_golden_vertebra());
  for (const Float3 place : partly->positions) {
    partly->tints.push_back(std::clamp(500.0f * (-0.004f - place.x), 0.0f, 1.0f));
  }
  add_vertebra(golden.scene, std::move(partly), render::kIdentity, kVertebraLabel);
  return golden;
}

GoldenScene rotated_vertebra() {
  GoldenScene golden =
      start("h2_vertebra_turned", "the same, from the side: rim where it turns away",
            close_view({0, 0.02f, 0}));
  render::Matrix4 rotation = render::kIdentity;
  rotation[0].x = rotation[2].z = std::cos(0.4f);
  rotation[2].x = std::sin(0.4f);
  rotation[0].z = -rotation[2].x;
  add_vertebra(golden.scene, make_golden_vertebra(), rotation, kVertebraLabel);
  return golden;
}

GoldenScene entry(const std::string& name, const std::string& what, const std::string& text,
                  bool done, LabelSide side) {
  const bool left = side == LabelSide::kLeft;
  const Float3 place = left ? kEntry : kOtherEntry;
  GoldenScene golden =
      start(name, what, close_view(place + Float3{left ? 0.0095f : -0.0095f, 0, 0}));
  add_entry(golden.scene, {place, left ? kNormal : kOtherNormal, text, done, side}, kEntryLabel);
  golden.covered = {{kEntryLabel, place}};
  golden.centred = {{kEntryLabel, place}};
  return golden;
}

GoldenScene trajectory(const std::string& name, const std::string& what, Float3 target) {
  GoldenScene golden = start(name, what, close_view({0.014f, 0.042f, 0.007f}));
  add_planned_trajectory(golden.scene, kEntry, target, kTrajectoryLabel);
  const Float3 outer = trajectory_outer_end(kEntry, target);
  golden.covered = {{kTrajectoryLabel, outer},
                    {kTrajectoryLabel, kEntry},
                    {kTrajectoryLabel, 0.5f * (outer + kEntry)}};
  return golden;
}

GoldenScene triangle(const std::string& name, const std::string& what, double angle_deg, Float3 b) {
  GoldenScene golden = start(name, what, close_view({0.022f, 0.072f, 0.010f}));
  const Float3 c = planned_point();
  add_deviation_triangle(golden.scene, kEntry, b, c, grade_of(angle_deg * kRadiansPerDegree),
                         kTriangleLabel);
  golden.covered = {{kTriangleLabel, kEntry}, {kTriangleLabel, b}, {kTriangleLabel, c}};
  return golden;
}

}  // namespace

void add_shape_scenes(std::vector<GoldenScene>& scenes) {
  scenes.push_back(path("h1_recording", "yellow ribbon of loops", PathState::kRecording));
  scenes.push_back(path("h1_saved", "orange ribbon of loops", PathState::kSaved));
  scenes.push_back(fading(0.5f));
  scenes.push_back(residuals());
  scenes.push_back(vertebra());
  scenes.push_back(bare_vertebra());
  scenes.push_back(rotated_vertebra());
  scenes.push_back(
      entry("h3_entry", "blue sphere in a ring, L4 left", "L4 left", false, LabelSide::kLeft));
  scenes.push_back(entry("h3_entry_done", "blue sphere in a ring, L4 left with a green tick",
                         "L4 left", true, LabelSide::kLeft));
  scenes.push_back(entry("h3_entry_right", "blue sphere in a ring, L4 right, name on the right",
                         "L4 right", false, LabelSide::kRight));
  scenes.push_back(
      entry("h3_entry_unnamed", "blue sphere in a ring, no name", "", false, LabelSide::kLeft));
  scenes.push_back(
      trajectory("h4_trajectory", "green: solid outside the bone, dashed inside", kTarget));
  scenes.push_back(trajectory("h4_trajectory_short", "green: solid outside, one dash inside",
                              kEntry - 0.009f * planned_direction()));
  scenes.push_back(triangle("h5_green", "thin green triangle, solid edges", 1.5, tool_point(1.5)));
  scenes.push_back(triangle("h5_amber", "amber triangle, solid edges", 3.8, tool_point(3.8)));
  scenes.push_back(triangle("h5_red", "red triangle, dashed edges", 12.4, tool_point(12.4)));
  scenes.push_back(
      triangle("h5_limit", "still amber at 5.0 degrees, solid edges", 5.0, tool_point(5.0)));
  scenes.push_back(triangle("h5_beside", "open green triangle: parallel, 3 mm beside the entry",
                            0.0, to_float3(guided(0.0, 0.003, 0.0).b.v)));
}

}  // namespace orthonav::engine::golden
