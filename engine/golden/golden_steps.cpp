#include <string>

#include "engine/golden/golden_operation.h"
#include "engine/golden/golden_vertebra.h"
#include "engine/holograms/shapes/render_values.h"
#include "render/float3.h"

namespace orthonav::engine::golden {
namespace {

using render::Float3;

nav::Region region_of(const std::vector<Float3>& stroke, std::size_t count, bool saved) {
  nav::Region region;
  for (std::size_t i = 0; i < count; ++i) {
    region.samples.push_back({Point<World>{to_vec3(stroke[i])}, Timestamp{}});
  }
  region.saved = saved;
  return region;
}

GoldenScene setup() {
  const StagedOperation s(Step::kSetup);
  return s.scene("setup", "the status line alone, what to say");
}

GoldenScene digitizing() {
  StagedOperation s(Step::kDigitize);
  s.coaching.stroke_next = nav::BonePlace{nav::BonePlace::Part::kLamina, Side::kLeft};
  s.coaching.progress = 0.7;
  s.coaching.stroke_at = Point<World>{to_vec3(on_golden_vertebra(0.014f, -0.010f))};
  s.guidance.status.state = StrokesSoFar{812, &s.coaching};
  s.regions = {region_of(stroke(), 120, true), region_of(stroke(Side::kLeft), 70, false)};
  GoldenScene golden = s.scene(
      "digitizing", "orange saved path, yellow one being recorded, a cyan ring where to go on");
  golden.covered = {{kPathLabel, stroke().front()}, {kOtherPathLabel, stroke(Side::kLeft)[69]}};
  return golden;
}

GoldenScene refused() {
  StagedOperation s(Step::kDigitize);
  s.regions = {region_of(stroke(), 120, true)};
  RegistrationRefused why;
  why.reasons = {{nav::RefusalReason::Kind::kTre99AtScrews, 0.0023, 0.0020, {}, {}, {}}};
  why.stroke_next = nav::BonePlace{nav::BonePlace::Part::kLamina, Side::kLeft};
  const Message message = why;
  s.guidance.status.message = &message;
  return s.scene("digitize_refused", "orange path, the reason in the status line");
}

/// In step `verify`, with a path by its distance.
void verify(StagedOperation& s) {
  s.regions = {region_of(stroke(), 120, true)};
  s.residuals_m.assign(120, 0.0004f);
  for (std::size_t i = 50; i < 70; ++i) {
    s.residuals_m[i] = 0.0016f;
  }
  s.guidance.status.state = ChecksSoFar{&s.verdict};
}

GoldenScene verifying() {
  StagedOperation s(Step::kVerify);
  verify(s);
  for (const Float3 place : kPlacesToCheck) {
    s.to_check.push_back({to_vec3(place)});
  }
  s.verdict.advice = {nav::CheckAdvice::Kind::kTouchApart, 3, 0.015, 0.0};
  return s.scene("verify", "the vertebra, its path by distance, one cyan diamond");
}

GoldenScene checked() {
  StagedOperation s(Step::kVerify);
  verify(s);
  constexpr std::array<double, 3> kDistances_m = {0.0004, 0.0031, 0.0033};
  for (std::size_t i = 0; i < kPlacesToCheck.size(); ++i) {
    s.level().check_points.push_back(
        {{to_vec3(kPlacesToCheck[i])}, kDistances_m[i], kDistances_m[i] <= 0.002});
  }
  s.verdict.advice = {nav::CheckAdvice::Kind::kReject, 3, 0.0033, 0.002};
  return s.scene("verify_checked", "the vertebra, a dim place, two red ones, the last in numbers");
}

GoldenScene checked_often() {
  StagedOperation s(Step::kVerify);
  verify(s);
  for (std::size_t i = 0; i < kPlacesToCheck.size(); ++i) {
    const Float3 place = kPlacesToCheck[i];
    const Float3 next = kPlacesToCheck[(i + 1) % kPlacesToCheck.size()];
    for (const float part : {0.0f, 0.14f, 0.28f, 0.42f}) {
      s.level().check_points.push_back({{to_vec3(place + part * (next - place))}, 0.0004, true});
    }
  }
  s.level().check_points.push_back(
      {{to_vec3(0.5f * (kPlacesToCheck[1] + kPlacesToCheck[2]))}, 0.0004, true});
  s.verdict.passed = true;
  return s.scene("verify_many", "the vertebra, small dim places and a green one at last");
}

GoldenScene accepted() {
  StagedOperation s(Step::kTouchLandmark);
  s.level().screws[1].done = false;
  s.level().landmark = Landmark{{to_vec3(on_golden_vertebra(0.0f, -0.014f))}, 0.0, {}};
  s.guidance.status.state = LandmarkSoFar{true, {}, nullptr, nullptr};
  return s.scene("landmark", "two named blue entries, a cyan diamond: touch the landmark");
}

/// In step `guide`, with a tip that was set there if it is drilling.
GoldenScene guide(const std::string& name, const std::string& what, const nav::ScrewGuidance& tool,
                  nav::DrillPhase phase, bool every_number = false) {
  StagedOperation s(Step::kGuide);
  s.measure(tool);
  s.guidance.drill = {phase, nav::DrillAlarm::kNone, true};
  s.guidance.was_set = phase != nav::DrillPhase::kAway;
  s.guidance.asked.numbers = every_number;
  GoldenScene golden = s.scene(name, what);
  golden.covered = {{kOtherEntryLabel, kOtherEntry}};
  return golden;
}

GoldenScene guide_published() {
  StagedOperation s(Step::kGuide);
  s.rules.cross_and_depth = false;
  s.measure(guided(3.4, 0.0026, -0.0062));
  return s.scene("guide_published", "as published: amber triangle, the angle beside it, no cross");
}

GoldenScene guide_predicted() {
  StagedOperation s(Step::kGuide);
  s.predict(guided(1.0, 0.0, 0.0));
  return s.scene("guide_predicted", "amber triangle, dashes, rings without dots");
}

GoldenScene guide_lost() {
  StagedOperation s(Step::kGuide);
  s.lose();
  return s.scene("guide_lost", "plan, dashes, tool lost across the ring");
}

GoldenScene guide_stop() {
  StagedOperation s(Step::kGuide);
  s.measure(guided(0.8, 0.0003, 0.0425));
  s.guidance.drill = {nav::DrillPhase::kDrilling, nav::DrillAlarm::kStop, true};
  return s.scene("guide_stop", "stop above the rings and the status line, the bar full and red");
}

GoldenScene operation_done() {
  StagedOperation s(Step::kDone);
  s.level().screws[0].done = true;
  return s.scene("done", "two entries with ticks");
}

}  // namespace

GoldenScene guidance_scene() {
  return guide("guidance", "3.4° off: an amber triangle, an arrow, the angle in a rim",
               guided(3.4, 0.0006, -0.0062), nav::DrillPhase::kAway);
}

void add_step_scenes(std::vector<GoldenScene>& scenes) {
  using enum nav::DrillPhase;
  scenes.push_back(setup());
  scenes.push_back(digitizing());
  scenes.push_back(refused());
  scenes.push_back(verifying());
  scenes.push_back(checked());
  scenes.push_back(checked_often());
  scenes.push_back(accepted());
  scenes.push_back(guide("guide_far", "plan, its entry's name, the distance at the tip",
                         guided(12.0, 0.030, -0.055), kAway));
  scenes.push_back(guide("guide_aside", "the same 32 mm beside the entry and deeper: no cross",
                         guided(12.0, 0.032, 0.004), kAway));
  scenes.push_back(guidance_scene());
  scenes.push_back(guide("guide_set", "within limits: green, three numbers, drill",
                         guided(0.8, 0.0004, 0.0002), kSet));
  scenes.push_back(guide("guide_beside",
                         "parallel, 2.6 mm beside the entry: red, the offset bright",
                         guided(0.4, 0.0026, -0.0021), kAway));
  scenes.push_back(guide("guide_drilling", "green triangle and dots, a larger bar filled a third",
                         guided(0.8, 0.0001, 0.0140), kDrilling));
  scenes.push_back(guide_stop());
  scenes.push_back(guide("guide_numbers", "with every number: directions, planes, clearance",
                         guided(0.8, 0.0004, 0.0002), kSet, true));
  scenes.push_back(guide_published());
  scenes.push_back(guide_predicted());
  scenes.push_back(guide_lost());
  scenes.push_back(operation_done());
}

}  // namespace orthonav::engine::golden
