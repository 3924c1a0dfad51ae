#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "base/angle.h"
#include "engine/golden/golden_stage.h"
#include "engine/holograms/scene_builder.h"
#include "render/decimated.h"
#include "render/float3.h"
#include "render/shapes.h"

namespace orthonav::engine::golden {
namespace {

using render::Float3;

constexpr std::array<Float3, 3> kHeads = {
    {{0.021f, 0.046f, -0.040f}, {0.017f, 0.049f, 0.0f}, {0.020f, 0.045f, 0.041f}}};

GoldenScene start_rod(const std::string& name, const std::string& what) {
  GoldenScene golden = start_wide(name, what, close_view({0.020f, 0.045f, -0.002f}));
  for (render::View& view : golden.views) {
    view.tan_left = view.tan_right = 0.200f;
    view.tan_up = view.tan_down = 0.130f;
  }
  return golden;
}

GoldenScene rod(const std::string& name, const std::string& what, Float3 offset,
                bool first_bend_only) {
  GoldenScene golden = start_rod(name, what);
  std::vector<Float3> centre_line;
  for (int i = 0; i <= 48; ++i) {
    // The parabola through the heads; the rod's own spline does not matter for this picture.
    const float t = static_cast<float>(i) / 24.0f;
    const float a = 0.5f * (t - 1) * (t - 2);
    const float b = t * (2 - t);
    const float c = 0.5f * t * (t - 1);
    centre_line.push_back(a * kHeads[0] + b * kHeads[1] + c * kHeads[2]);
  }
  const std::array<RodBendMark, 2> bends = {
      {{centre_line[16], 6.2 * kRadiansPerDegree, 0.0271,
        RodBendMark::Making{0.0, 10.4 * kRadiansPerDegree}},
       {centre_line[34], 4.9 * kRadiansPerDegree, 0.0578,
        RodBendMark::Making{40.0 * kRadiansPerDegree, 9.0 * kRadiansPerDegree}}}};
  RodHologram hologram;
  hologram.tube = render::prepared(render::make_tube(centre_line, 0.00275f));
  hologram.heads = kHeads;
  hologram.bends = bends;
  hologram.length_m = 0.0820;
  hologram.to_cut = true;
  constexpr std::array<std::string_view, 3> kNames = {"L5", "L4", "L3"};
  hologram.head_names = kNames;
  hologram.offset = offset;
  hologram.first_bend_only = first_bend_only;
  add_rod(golden.scene, hologram, kRodLabel);
  for (const Float3 head : kHeads) {
    golden.covered.push_back({kRodLabel, head + offset});
  }
  return golden;
}

/// Too few heads for a rod.
GoldenScene heads(const std::string& name, const std::string& what, std::size_t count) {
  GoldenScene golden = start_rod(name, what);
  RodHologram hologram;
  hologram.heads = std::span(kHeads).first(count);
  add_rod(golden.scene, hologram, kRodLabel);
  for (std::size_t i = 0; i < count; ++i) {
    golden.covered.push_back({kRodLabel, kHeads[i]});
  }
  return golden;
}

GoldenScene status(const std::string& name, const std::string& what, const std::string& text,
                   ToolState pointer, ToolState guide) {
  GoldenScene golden = start_wide(name, what, surgeon_views());
  golden.views.resize(1);
  const std::array<ToolDot, 2> tools = {{{pointer}, {guide}}};
  add_status_line(golden.scene, text, tools, kStatusLabel);
  return golden;
}

/// A whole scene of which only the head-fixed holograms are left.
GoldenScene head_lost() {
  GoldenScene golden =
      status("h11_head_lost", "status line, a line with a red rim above it, nothing else",
             "guide L4 left | drill", ToolState::kMeasured, ToolState::kMeasured);
  render::Scene whole = golden.scene;
  whole.lines.push_back(
      {kAngleLabel, {kPlacesToCheck[0], kPlacesToCheck[1]}, 0.002f, look::colours().good});
  write_head_lost(whole, golden.scene);
  return golden;
}

GoldenScene check(const std::string& name, const std::string& what, double distance_m,
                  bool within) {
  GoldenScene golden = start(name, what, close_view({0.006f, 0.052f, -0.006f}));
  const Float3 place{0, 0.052f, -0.006f};
  add_check_point(golden.scene, place, distance_text(distance_m), within, kCheckPointLabel);
  golden.covered = golden.centred = {{kCheckPointLabel, place}};
  return golden;
}

GoldenScene to_check() {
  GoldenScene golden =
      start("h12_to_check", "three cyan diamonds", close_view({0, 0.042f, 0.002f}));
  std::size_t k = 0;
  for (const Float3 place : kPlacesToCheck) {
    const render::Label label = label_of(HologramKind::kCheckPoint, ++k);
    add_place_to_check(golden.scene, place, label);
    golden.covered.push_back({label, place});
    golden.centred.push_back({label, place});
  }
  return golden;
}

}  // namespace

void add_other_scenes(std::vector<GoldenScene>& scenes) {
  scenes.push_back(rod(
      "h10_rod",
      "titanium rod through three named blue heads, two amber bends, the first with how to make "
      "it, what to cut to",
      {}, true));
  scenes.push_back(rod("h10_rod_moved", "the same rod, moved aside, how to make both bends",
                       {0.014f, -0.006f, -0.006f}, false));
  scenes.push_back(heads("h10_one_head", "one blue head, no rod, no length", 1));
  scenes.push_back(heads("h10_no_rod", "two blue heads that make no rod, no length", 2));
  scenes.push_back(status("h11_measured", "status line low in view, two filled dots in green rims",
                          "verify L4 | passed: say accept result", ToolState::kMeasured,
                          ToolState::kMeasured));
  scenes.push_back(status("h11_lost", "status line: pointer half in amber, guide hollow in red",
                          "digitize L4 | refused: registration RMSE 3.4 mm, limit 3.0 mm",
                          ToolState::kPredicted, ToolState::kLost));
  scenes.push_back(
      status("h11_short", "status line: one word", "done", ToolState::kLost, ToolState::kMeasured));
  scenes.push_back(head_lost());
  scenes.push_back(to_check());
  scenes.push_back(check("h12_within", "green diamond, 0.4 mm and a tick", 0.0004, true));
  scenes.push_back(check("h12_off", "red diamond, 3.1 mm and a cross in a red rim", 0.0031, false));
  scenes.push_back(
      check("h12_nowhere", "red diamond, -- mm and a cross in a red rim", std::nan(""), false));
}

}  // namespace orthonav::engine::golden
