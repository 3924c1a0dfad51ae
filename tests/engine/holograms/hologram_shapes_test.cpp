#include "engine/holograms/shapes/hologram_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "render/float3.h"
#include "render/projection.h"
#include "render/text/text_layout.h"

namespace orthonav::engine {
namespace {

using render::Float3;

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

TEST(AngleText, HasOneDecimalAndItsUnit) {
  EXPECT_EQ(angle_text(12.44 * kRadiansPerDegree), "12.4°");
  EXPECT_EQ(angle_text(0.0), "0.0°");
  EXPECT_EQ(angle_text(99.94 * kRadiansPerDegree), "99.9°");
}

TEST(AngleText, ShowsALostValueAsDashesNeverAsANumber) {
  EXPECT_EQ(angle_text(std::nullopt), "--.-°");
  EXPECT_EQ(angle_text(std::nan("")), "--.-°");
  EXPECT_EQ(angle_text(std::numeric_limits<double>::infinity()), "--.-°");
  EXPECT_EQ(angle_text(-0.01), "--.-°");
  EXPECT_EQ(angle_text(99.96 * kRadiansPerDegree), "--.-°") << "would read 100.0";
}

TEST(Grade, ChangesAtTwoAndFiveDegrees) {
  EXPECT_EQ(grade_of(1.99 * kRadiansPerDegree), Grade::kGood);
  EXPECT_EQ(grade_of(2.01 * kRadiansPerDegree), Grade::kFair);
  EXPECT_EQ(grade_of(4.99 * kRadiansPerDegree), Grade::kFair);
  EXPECT_EQ(grade_of(5.01 * kRadiansPerDegree), Grade::kPoor);
  EXPECT_EQ(grade_of(std::nan("")), Grade::kPoor);
  EXPECT_EQ(grade_of(1.5 * kRadiansPerDegree, {0.01, 0.02}), Grade::kPoor) << "configurable";
}

TEST(DeviationTriangle, IsDashedOnlyWhenPoorSoThatColourIsNotAlone) {
  for (const Grade grade : {Grade::kGood, Grade::kFair, Grade::kPoor}) {
    render::Scene scene;
    add_deviation_triangle(scene, {0, 0, 0}, {0, 0.08f, 0}, {0.01f, 0.08f, 0}, grade, 501);
    ASSERT_EQ(scene.lines.size(), 1u);
    EXPECT_EQ(scene.lines[0].dash_m > 0, grade == Grade::kPoor);
    EXPECT_FLOAT_EQ(scene.triangles.at(0).colour.a, 0.30f);
    EXPECT_FLOAT_EQ(scene.lines[0].width_m, 0.001f);
  }
}

TEST(AngleReadout, KeepsItsWidthWhateverItSays) {
  const render::Font font;
  const auto width_of = [&](const std::string& text) {
    render::Scene scene;
    add_angle_readout(scene, {0, 0, 0}, {0, 0.08f, 0}, text, Grade::kGood, 601);
    return render::line_width(font, scene.texts.at(0));
  };
  const float width = width_of("12.4°");
  EXPECT_FLOAT_EQ(width_of("9.5°"), width) << "a blank holds the place";
  EXPECT_FLOAT_EQ(width_of("--.-°"), width);
}

TEST(AngleReadout, StandsClearOfTheEntryEvenSeenAlongTheTool) {
  const Float3 a = {0, 0, 0};
  const Float3 b = {0, 0.08f, 0};
  render::Scene scene;
  add_angle_readout(scene, a, b, "12.4°", Grade::kFair, 601);
  const render::TextItem& text = scene.texts.at(0);
  const render::View view = render::look_at({0, 0.5f, 0}, a, {0, 0, -1}, 0.394f, 0.2561f);
  const auto left = render::project(view, text.position, 1268, 824);
  const auto entry = render::project(view, a, 1268, 824);
  ASSERT_TRUE(left && entry);
  const float cap_px = 0.0140f * 1268 / 0.788f;  // 0.8 degrees
  EXPECT_GT(left->x_px + text.offset_right * cap_px - entry->x_px, 10);
  EXPECT_GE(text.min_height_deg, 0.8f);
}

TEST(PlannedTrajectory, StandsSixtyMillimetresOut) {
  const Float3 entry = {0.01f, 0.02f, 0.03f};
  const Float3 target = {0.01f, -0.02f, 0.03f};
  EXPECT_NEAR(render::length(trajectory_outer_end(entry, target) - Float3{0.01f, 0.08f, 0.03f}), 0,
              1e-6);
  render::Scene scene;
  add_planned_trajectory(scene, entry, target, 401);
  ASSERT_EQ(scene.lines.size(), 2u);
  EXPECT_EQ(scene.lines[0].dash_m, 0);
  EXPECT_GT(scene.lines[1].dash_m, 0);
  EXPECT_EQ(scene.lines[1].points.back(), target);
  for (const render::LineItem& line : scene.lines) {
    EXPECT_FLOAT_EQ(line.width_m, 0.002f);
  }
}

TEST(Entry, GetsATickWhenTheScrewIsIn) {
  for (const bool done : {false, true}) {
    render::Scene scene;
    add_entry(scene, {{0, 0, 0}, {0, 1, 0}, "L4 left", done}, 301);
    std::string text;
    for (const render::TextRun& run : scene.texts.at(0).runs) {
      text += run.text;
    }
    EXPECT_EQ(text, done ? "L4 left ✓" : "L4 left");
  }
}

TEST(SampledPath, FadesAndVanishes) {
  const std::vector<Float3> samples = {{0, 0, 0}, {0.01f, 0, 0}};
  render::Scene scene;
  add_sampled_path(scene, samples, PathState::kSaved, 101, 0.5f);
  EXPECT_FLOAT_EQ(scene.lines.at(0).colour.a, 0.5f);
  add_sampled_path(scene, samples, PathState::kSaved, 101, 0.0f);
  add_sampled_path(scene, {}, PathState::kSaved, 101);
  EXPECT_EQ(scene.lines.size(), 1u);
}

TEST(Rod, ShowsTheRodWithoutHeadsAndHeadsWithoutARod) {
  render::Scene scene;
  add_rod(scene, {}, 1001);
  EXPECT_TRUE(scene.meshes.empty() && scene.texts.empty());
  const std::vector<Float3> heads = {{0, 0, 0}};
  RodHologram rod;
  rod.heads = heads;
  rod.offset = {0.1f, 0, 0};
  add_rod(scene, rod, 1001);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_FLOAT_EQ(scene.meshes[0].world_from_model[3].x, 0.1f);
  EXPECT_TRUE(scene.texts.empty()) << "one head has no length";
}

}  // namespace
}  // namespace orthonav::engine
