#include "engine/golden_scenes.h"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "engine/golden_vertebra.h"
#include "engine/hologram_shapes.h"
#include "hal/api/angle.h"
#include "render/float3.h"
#include "render/projection.h"
#include "render/shapes.h"

namespace orthonav::engine {
namespace {

using render::Float3;

// One patient for all pictures, prone: posterior is up. Metres.
constexpr Float3 kEntry = {0.0165f, 0.0320f, 0.0070f};
constexpr Float3 kTarget = {0.0080f, -0.0110f, 0.0040f};
constexpr Float3 kOtherEntry = {-0.0165f, 0.0320f, 0.0070f};
constexpr Float3 kNormal = {0.25f, 0.95f, 0.15f};
constexpr float kToolLength_m = 0.080f;

Float3 planned_direction() { return render::unit_or(kEntry - kTarget, {}); }
Float3 planned_point() { return kEntry + kToolLength_m * planned_direction(); }

/// The point B of a tool that is off by the angle, towards the patient's left and head.
Float3 tool_point(double angle_deg) {
  const Float3 along = planned_direction();
  const Float3 side = render::unit_or(cross({0.3f, 0, -1}, along), {});
  const auto angle_rad = static_cast<float>(angle_deg * kRadiansPerDegree);
  return kEntry + kToolLength_m * (std::cos(angle_rad) * along + std::sin(angle_rad) * side);
}

/// Near enough to judge one hologram: 14° wide.
std::vector<render::View> close_view(Float3 target) {
  const Float3 eye = target + Float3{0.24f, 0.36f, -0.16f};
  return {render::look_at(eye, target, {0, 0.3f, 1}, 0.120f, 0.078f)};
}

/// The surgeon's own: both eyes, a HoloLens 2's 43°.
std::vector<render::View> surgeon_views() {
  const render::View between =
      render::look_at({0.19f, 0.37f, -0.20f}, {0, 0.045f, 0}, {0, 0.3f, 1}, 0.394f, 0.2561f);
  return render::stereo_pair(between);
}

GoldenScene start(std::string name, std::string what, std::vector<render::View> views) {
  GoldenScene golden;
  golden.name = std::move(name);
  golden.what = std::move(what);
  golden.views = std::move(views);
  return golden;
}

/// Strokes over lamina and spinous process, as a surgeon lays them.
std::vector<Float3> stroke() {
  std::vector<Float3> samples;
  for (int i = 0; i < 120; ++i) {
    const float t = static_cast<float>(i) / 119.0f;
    const float turn = t * 3.0f * 2.0f * std::numbers::pi_v<float>;
    samples.push_back({-0.020f + 0.016f * t + 0.0035f * std::cos(turn), 0.038f + 0.004f * t,
                       0.004f - 0.010f * t + 0.005f * std::sin(turn)});
  }
  return samples;
}

GoldenScene path(const std::string& name, const std::string& what, PathState state) {
  GoldenScene golden = start(name, what, close_view({-0.012f, 0.04f, -0.001f}));
  const std::vector<Float3> samples = stroke();
  add_sampled_path(golden.scene, samples, state, 101);
  golden.covered = {{101, samples.front()}, {101, samples[60]}, {101, samples.back()}};
  return golden;
}

GoldenScene vertebra() {
  GoldenScene golden = start("h2_vertebra", "a vertebra: bright rim, dark see-through inside",
                             close_view({0, 0.02f, 0}));
  add_vertebra(golden.scene, make_golden_vertebra(), render::kIdentity, 201);
  golden.covered = {{201, {0, 0.0655f, -0.0185f}},
                    {201, {0.0445f, 0.030f, 0.009f}},
                    {201, {-0.0445f, 0.030f, 0.009f}},
                    {201, {0.0185f, 0.033f, 0.014f}}};
  return golden;
}

GoldenScene entry(const std::string& name, const std::string& what, bool done) {
  GoldenScene golden = start(name, what, close_view({0.026f, 0.032f, 0.007f}));
  add_entry(golden.scene, {kEntry, kNormal, "L4 left", done, LabelSide::kLeft}, 301);
  golden.covered = {{301, kEntry}};
  golden.centred = {{301, kEntry}};
  return golden;
}

GoldenScene trajectory() {
  GoldenScene golden = start("h4_trajectory", "green: solid outside the bone, dashed inside",
                             close_view({0.014f, 0.042f, 0.007f}));
  add_planned_trajectory(golden.scene, kEntry, kTarget, 401);
  const Float3 outer = trajectory_outer_end(kEntry, kTarget);
  golden.covered = {{401, outer}, {401, kEntry}, {401, 0.5f * (outer + kEntry)}};
  return golden;
}

GoldenScene triangle(const std::string& name, const std::string& what, double angle_deg) {
  GoldenScene golden = start(name, what, close_view({0.022f, 0.072f, 0.010f}));
  const Float3 b = tool_point(angle_deg);
  const Float3 c = planned_point();
  add_deviation_triangle(golden.scene, kEntry, b, c, grade_of(angle_deg * kRadiansPerDegree), 501);
  golden.covered = {{501, kEntry}, {501, b}, {501, c}};
  return golden;
}

GoldenScene readout(const std::string& name, const std::string& what,
                    std::optional<double> angle_deg) {
  GoldenScene golden = start(name, what, close_view({0.035f, 0.115f, 0.01f}));
  std::optional<double> angle_rad;
  if (angle_deg) angle_rad = *angle_deg * kRadiansPerDegree;
  const Float3 b = tool_point(angle_deg.value_or(4.0));
  add_angle_readout(golden.scene, kEntry, b, angle_text(angle_rad),
                    grade_of(angle_rad.value_or(1.0)), 601);
  return golden;
}

GoldenScene rod() {
  GoldenScene golden =
      start("h10_rod", "titanium rod through three blue heads, two amber bends, length",
            close_view({0.020f, 0.045f, -0.002f}));
  golden.width_px = 720;
  golden.height_px = 468;
  for (render::View& view : golden.views) {
    view.tan_left = view.tan_right = 0.200f;
    view.tan_up = view.tan_down = 0.130f;
  }
  constexpr std::array<Float3, 3> heads = {
      {{0.021f, 0.046f, -0.040f}, {0.017f, 0.049f, 0.0f}, {0.020f, 0.045f, 0.041f}}};
  std::vector<Float3> centre_line;
  for (int i = 0; i <= 48; ++i) {
    // The parabola through the heads; the rod's own spline is not this picture's matter.
    const float t = static_cast<float>(i) / 24.0f;
    const float a = 0.5f * (t - 1) * (t - 2);
    const float b = t * (2 - t);
    const float c = 0.5f * t * (t - 1);
    centre_line.push_back(a * heads[0] + b * heads[1] + c * heads[2]);
  }
  const std::array<RodBendMark, 2> bends = {{{centre_line[16], 6.2 * kRadiansPerDegree, 0.0271},
                                             {centre_line[34], 4.9 * kRadiansPerDegree, 0.0578}}};
  RodHologram hologram;
  hologram.tube =
      std::make_shared<const render::MeshData>(render::make_tube(centre_line, 0.00275f));
  hologram.heads = heads;
  hologram.bends = bends;
  hologram.length_m = 0.0820;
  add_rod(golden.scene, hologram, 1001);
  for (const Float3 head : heads) golden.covered.push_back({1001, head});
  return golden;
}

GoldenScene status(const std::string& name, const std::string& what, const std::string& text,
                   ToolState pointer, ToolState guide) {
  GoldenScene golden = start(name, what, surgeon_views());
  golden.views.resize(1);
  golden.width_px = 720;
  golden.height_px = 468;
  const std::array<ToolDot, 2> tools = {{{"pointer", pointer}, {"guide", guide}}};
  add_status_line(golden.scene, text, tools, 1101);
  return golden;
}

/// Everything that a surgeon has before the eyes while turning the guide.
GoldenScene guidance() {
  GoldenScene golden = start(
      "guidance", "guiding the left screw of L4, the right one done, both eyes", surgeon_views());
  golden.width_px = 720;
  golden.height_px = 468;
  constexpr double kAngle_deg = 3.4;
  const Float3 b = tool_point(kAngle_deg);
  const Grade grade = grade_of(kAngle_deg * kRadiansPerDegree);
  render::Scene& scene = golden.scene;
  add_vertebra(scene, make_golden_vertebra(), render::kIdentity, 201);
  add_entry(scene, {kEntry, kNormal, "L4 left", false, LabelSide::kLeft}, 301);
  add_entry(scene, {kOtherEntry, {-0.25f, 0.95f, 0.15f}, "L4 right", true, LabelSide::kRight}, 302);
  add_planned_trajectory(scene, kEntry, kTarget, 401);
  add_deviation_triangle(scene, kEntry, b, planned_point(), grade, 501);
  add_angle_readout(scene, kEntry, b, angle_text(kAngle_deg * kRadiansPerDegree), grade, 601);
  const std::array<ToolDot, 2> tools = {
      {{"guide", ToolState::kMeasured}, {"reference", ToolState::kPredicted}}};
  add_status_line(scene, "guide L4 left | RMSE 0.62 mm | predicted 1.1 mm", tools, 1101);
  golden.covered = {{501, b}, {501, planned_point()}, {302, kOtherEntry}};
  return golden;
}

/// Digitizing: a saved region, one being recorded.
GoldenScene digitizing() {
  GoldenScene golden = start(
      "digitizing", "orange saved path, yellow one being recorded, both eyes", surgeon_views());
  golden.width_px = 720;
  golden.height_px = 468;
  const std::vector<Float3> saved = stroke();
  std::vector<Float3> recording = saved;
  for (Float3& p : recording) p = {-p.x, p.y, p.z};
  recording.resize(70);
  add_sampled_path(golden.scene, saved, PathState::kSaved, 101);
  add_sampled_path(golden.scene, recording, PathState::kRecording, 102);
  const std::array<ToolDot, 1> tools = {{{"pointer", ToolState::kMeasured}}};
  add_status_line(golden.scene, "digitize L4 | 812 points", tools, 1101);
  golden.covered = {{101, saved.front()}, {102, recording.back()}};
  return golden;
}

}  // namespace

std::vector<GoldenScene> golden_scenes() {
  std::vector<GoldenScene> scenes;
  scenes.push_back(path("h1_recording", "yellow ribbon of loops", PathState::kRecording));
  scenes.push_back(path("h1_saved", "orange ribbon of loops", PathState::kSaved));
  scenes.push_back(vertebra());
  scenes.push_back(entry("h3_entry", "blue sphere in a ring, L4 left", false));
  scenes.push_back(
      entry("h3_entry_done", "blue sphere in a ring, L4 left with a green tick", true));
  scenes.push_back(trajectory());
  scenes.push_back(triangle("h5_green", "thin green triangle, solid edges", 1.5));
  scenes.push_back(triangle("h5_amber", "amber triangle, solid edges", 3.8));
  scenes.push_back(triangle("h5_red", "red triangle, dashed edges", 12.4));
  scenes.push_back(readout("h6_green", "1.2° in white, green rim", 1.2));
  scenes.push_back(readout("h6_amber", "3.8° in white, amber rim", 3.8));
  scenes.push_back(readout("h6_red", "12.4° in white, red rim", 12.4));
  scenes.push_back(readout("h6_lost", "dashes instead of a number, red rim", std::nullopt));
  scenes.push_back(rod());
  scenes.push_back(status("h11_measured", "status line low in view, two filled green dots",
                          "verify L4 | RMSE 0.62 mm | predicted 1.1 mm", ToolState::kMeasured,
                          ToolState::kMeasured));
  scenes.push_back(status("h11_lost", "status line: pointer half amber, guide hollow red",
                          "digitize L4 | refused: registration RMSE 3.4 mm, limit 3.0 mm",
                          ToolState::kPredicted, ToolState::kLost));
  scenes.push_back(digitizing());
  scenes.push_back(guidance());
  return scenes;
}

render::Image golden_background(int width_px, int height_px) {
  render::Image image;
  image.width_px = width_px;
  image.height_px = height_px;
  const auto channel = [](int value) { return static_cast<std::uint8_t>(value); };
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      // Drapes green to blue, in the middle a wound, red; all in whole numbers.
      const int dx = 200 * x / width_px - 100;
      const int dy = 200 * y / height_px - 100;
      const bool wound = 4 * dx * dx + 9 * dy * dy < 4 * 70 * 70;
      const int uneven = (x / 9 + y / 7) % 5 * 4;
      image.rgba.push_back(channel(wound ? 118 + uneven : 34 + uneven));
      image.rgba.push_back(channel(wound ? 42 + uneven : 74 + uneven));
      image.rgba.push_back(channel(wound ? 38 + uneven : 78 + 20 * x / width_px));
      image.rgba.push_back(255);
    }
  }
  return image;
}

}  // namespace orthonav::engine
