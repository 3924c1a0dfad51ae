#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "engine/holograms/shapes/hologram_cross.h"
#include "engine/holograms/shapes/hologram_shapes.h"
#include "tests/engine/holograms/shown_holograms.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::scene_builder_test {
namespace {

using test::guide_at;
using test::ScriptedOperation;
using enum HologramKind;

/// The guide is 10 mm before the left screw's entry and 0.1 rad off its axis.
class Guiding : public ::testing::Test {
 protected:
  Guiding() {
    s.accepts_first_level();
    s.says("next");
    s.tracker().guide = guide_at(kLeftEntry + Vec3{0, 0.010, 0}, 0.1);
    s.pairs(3);
  }
  ScriptedOperation s;
};

/// The dots of the status line for lost tools.
std::size_t lost_dots(const Guidance& g) {
  SceneBuilder builder;
  builder.update(g);
  render::Scene scene;
  builder.write_scene(g, scene);
  return static_cast<std::size_t>(
      std::count_if(scene.texts.begin(), scene.texts.end(), [](const render::TextItem& text) {
        return kind_of(text.label) == kStatus && !text.runs.empty() && text.runs[0].text == "○";
      }));
}

TEST_F(Guiding, HasNoDotOfALostToolThatNobodyNeedsInThisStep) {
  s.tracker().pointer.reset();
  EXPECT_EQ(lost_dots(s.pairs(30)), 0u);
  s.tracker().guide.reset();
  EXPECT_EQ(lost_dots(s.pairs(30)), 1u) << "the guide's";
}

TEST_F(Guiding, ShowsPlanTriangleAndAngle) {
  const Guidance& g = s.pair();
  EXPECT_THAT(drawn(g), ::testing::ElementsAre(kEntry, kTrajectory, kTriangle, kAngle, kCross,
                                               kDepth, kStatus, kNumbers));
  EXPECT_EQ(drawn(g), told(g));
  const ShownFrame frame = shown(g);
  EXPECT_EQ(find(frame, kAngle)->text, "5.8°?") << "0.1 rad, rounded up; nobody knows how sure";
  const auto& line = find(frame, kTrajectory)->points_in_world;
  ASSERT_EQ(line.size(), 3u);
  EXPECT_NEAR((line[0].v - Vec3{0.015, 0.080, 0}).norm(), 0.0, 1e-8) << "60 mm outside";
  EXPECT_NEAR((line[1].v - kLeftEntry).norm(), 0.0, kExact);
  const auto& triangle = find(frame, kTriangle)->points_in_world;
  ASSERT_EQ(triangle.size(), 3u);
  EXPECT_NEAR((triangle[0].v - kLeftEntry).norm(), 0.0, kExact);
  EXPECT_NEAR((triangle[1] - triangle[0]).norm(), nav::kTriangleReach_m, kExact);
  EXPECT_NEAR((triangle[2] - triangle[0]).norm(), nav::kTriangleReach_m, kExact);
}

TEST_F(Guiding, ATipBesideTheEntryOpensTheTriangleAndLeavesTheNumber) {
  constexpr double kBeside_m = 0.003;
  std::array<double, 2> open_m{};
  for (const std::size_t i : {0U, 1U}) {
    const double beside_m = i == 0 ? 0.0 : kBeside_m;
    s.tracker().guide = guide_at(kLeftEntry + Vec3{beside_m, 0.010, 0}, 0.0);
    const Guidance& g = s.pairs(2);
    const ShownFrame frame = shown(g);
    EXPECT_EQ(find(frame, kAngle)->text, "0.1°?") << "unknown errors: never 0.0";
    const auto& triangle = find(frame, kTriangle)->points_in_world;
    ASSERT_EQ(triangle.size(), 3u);
    open_m[i] = (triangle[1] - triangle[2]).norm();
  }
  EXPECT_NEAR(open_m[0], 0.0, 1e-6);
  EXPECT_NEAR(open_m[1], kBeside_m, 0.001 * kBeside_m);
}

TEST_F(Guiding, TheCrossHasADotForTheTipAndOneForTheToolFartherUp) {
  // 2 mm beside the plan towards the patient's left, parallel to it.
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0.002, 0.010, 0}, 0.0);
  const Guidance& g = s.pairs(2);
  const ShownFrame frame = shown(g);
  const auto& points = find(frame, kCross)->points_in_world;
  ASSERT_EQ(points.size(), 3u);
  const double drawn_m = static_cast<double>(kCrossScale) * 0.002;
  EXPECT_NEAR((points[1] - points[0]).norm(), drawn_m, 1e-6);
  EXPECT_NEAR((points[2] - points[1]).norm(), 0.0, 1e-6) << "parallel";
  EXPECT_EQ(find(frame, kCross)->text, "");
  // Turned about its tip: the tip's dot stays, the other moves.
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0.002, 0.010, 0}, 0.02);
  const ShownFrame rotated = shown(s.pairs(2));
  const auto& after = find(rotated, kCross)->points_in_world;
  EXPECT_NEAR((after[1] - points[1]).norm(), 0.0, 1e-6);
  EXPECT_GT((after[2] - points[2]).norm(), 0.003);
}

TEST_F(Guiding, TheCrossShowsNoDotOfAPredictionAndSaysWhenTheToolIsLost) {
  s.tracker().guide_origin = PoseStatus::kPredicted;
  const ShownFrame predicted = shown(s.pair());
  EXPECT_EQ(find(predicted, kCross)->points_in_world.size(), 1u);
  EXPECT_EQ(find(predicted, kCross)->text, "");
  EXPECT_EQ(find(predicted, kDepth), nullptr);
  const ShownFrame lost = shown(s.pairs(4));
  EXPECT_EQ(find(lost, kCross)->points_in_world.size(), 1u);
  EXPECT_EQ(find(lost, kCross)->text, "tool lost");
}

TEST_F(Guiding, SaysHowFarItIsToTheEntryAndThenToTheTarget) {
  EXPECT_EQ(find(shown(s.pair()), kDepth)->text, "10.0 mm? to entry")
      << "this registration does not know how sure it is";
  s.tracker().guide = guide_at(kLeftEntry - Vec3{0, 0.004, 0}, 0.0);
  const std::string inside = find(shown(s.pairs(2)), kDepth)->text;
  EXPECT_THAT(inside, ::testing::EndsWith(" mm? to target"));
  s.tracker().guide = guide_at(kLeftEntry - Vec3{0, 0.039, 0}, 0.0);
  EXPECT_THAT(find(shown(s.pairs(2)), kDepth)->text, ::testing::EndsWith(" mm? past target"));
}

TEST_F(Guiding, TheTwinComesAndGoesOnRequest) {
  EXPECT_EQ(find(shown(s.pair()), kTwin), nullptr);
  const Guidance& g = s.says("twin");
  EXPECT_THAT(drawn(g), ::testing::Contains(kTwin));
  EXPECT_EQ(drawn(g), told(g));
  const ShownFrame frame = shown(g);
  const auto& twin = find(frame, kTwin)->points_in_world;
  const auto& line = find(frame, kTrajectory)->points_in_world;
  ASSERT_EQ(twin.size(), 2u);
  EXPECT_NEAR((twin[1] - twin[0]).norm(), 2.0 * (line[2] - line[1]).norm(), 1e-6);
  EXPECT_EQ(find(shown(s.says("twin")), kTwin), nullptr);
}

TEST_F(Guiding, AwayFromTheScrewShowsTheDistanceAtTheTipAlone) {
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0, 0.0399, 0}, 0.0);
  s.pair();
  EXPECT_NE(find(shown(s.pair()), kTriangle), nullptr);
  EXPECT_EQ(find_entry(shown(s.pair()), "L4", Side::kLeft)->text, "");
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0, 0.0401, 0}, 0.0);
  s.pair();
  const Guidance& g = s.pair();
  EXPECT_THAT(drawn(g), ::testing::ElementsAre(kEntry, kTrajectory, kDepth, kStatus, kNumbers));
  const ShownFrame far = shown(g);
  EXPECT_EQ(find(far, kDepth)->text, "40 mm");
  EXPECT_EQ(find_entry(far, "L4", Side::kLeft)->text, "left") << "which screw it is";
  EXPECT_EQ(find_entry(far, "L4", Side::kRight)->text, "");
  EXPECT_EQ(far.status->text, "guide L4 left | tip to the entry");
}

TEST_F(Guiding, ATipBesideTheScrewIsOnItsWayHoweverDeepItIs) {
  for (const double beside_m : {0.0151, 0.032}) {
    // Below the plane of the entry, as beside a slope of the bone.
    s.tracker().guide = guide_at(kLeftEntry + Vec3{beside_m, -0.004, 0}, 0.0);
    const Guidance& g = s.pairs(2);
    EXPECT_THAT(drawn(g), ::testing::ElementsAre(kEntry, kTrajectory, kDepth, kStatus, kNumbers));
    EXPECT_EQ(shown(g).status->text, "guide L4 left | tip to the entry");
  }
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0.0149, -0.004, 0}, 0.0);
  EXPECT_NE(find(shown(s.pairs(2)), kCross), nullptr) << "the control";
}

TEST_F(Guiding, ADrillThatRunsOffTheAxisKeepsTheCross) {
  s.tracker().guide = guide_at(kLeftEntry - Vec3{0, 0.004, 0}, 0.0);
  s.pairs(2);
  s.says("drill");
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0.020, -0.008, 0}, 0.0);
  const Guidance& g = s.pairs(2);
  ASSERT_EQ(g.drill.phase, nav::DrillPhase::kDrilling);
  EXPECT_NE(find(shown(g), kCross), nullptr);
}

TEST_F(Guiding, KeepsTheCrossDownToTheTarget) {
  // The tip 39 mm deep and more than 40 from the entry: 3 mm past the target, beside the axis.
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0.009, -0.0395, 0}, 0.0);
  s.pair();
  EXPECT_NE(find(shown(s.pair()), kCross), nullptr);
}

TEST_F(Guiding, ALostToolHidesTheTriangleAndTheNumberSaysSo) {
  // The tracker goes on predicting; the overlay stands for a moment, without a number.
  s.tracker().guide_origin = PoseStatus::kPredicted;
  const Guidance& fresh = s.pair();
  EXPECT_NE(find(shown(fresh), kTriangle), nullptr);
  EXPECT_EQ(find(shown(fresh), kAngle)->text, "--.-°");
  EXPECT_EQ(drawn(fresh), told(fresh));
  const Guidance& g = s.pairs(4);
  const ShownFrame frame = shown(g);
  EXPECT_EQ(find(frame, kTriangle), nullptr);
  ASSERT_NE(find(frame, kAngle), nullptr);
  EXPECT_EQ(find(frame, kAngle)->text, "--.-°");
  EXPECT_TRUE(g.status.tool_lost);
  EXPECT_EQ(frame.status->text, line_of(g));
}

TEST_F(Guiding, AFrameThatLightsUpTooLateShowsNoTriangle) {
  // Fresh when it was computed; the display's latency makes it old.
  s.latency = std::chrono::milliseconds(101);
  EXPECT_EQ(find(shown(s.pair()), kTriangle), nullptr);
  s.latency = std::chrono::milliseconds(99);
  EXPECT_NE(find(shown(s.pair()), kTriangle), nullptr);
}

TEST_F(Guiding, TicksAScrewThatIsDone) {
  s.says("next");
  // At the other screw: on the way there its entry would be named.
  s.tracker().guide = guide_at(kLeftEntry - Vec3{2.0 * kLeftEntry.x, 0, 0}, 0.0);
  s.pairs(2);
  std::size_t ticks = 0;
  for (const render::TextItem& text : scene_of(s.pair()).texts) {
    if (kind_of(text.label) == kEntry) {
      for (const render::TextRun& run : text.runs) {
        ticks += run.text == " ✓" ? 1 : 0;
        EXPECT_EQ(run.text.find("right"), std::string::npos) << "the other one is guided";
      }
    }
  }
  EXPECT_EQ(ticks, 1u);
}

TEST_F(Guiding, ARejectedRegistrationTakesItsHologramsAlong) {
  const Guidance& g = s.says("reject");
  EXPECT_THAT(drawn(g), ::testing::ElementsAre(kStatus));
  EXPECT_EQ(drawn(g), told(g));
}

TEST_F(Guiding, GradesByTheLimitsItWasGiven) {
  const Guidance& g = s.pair();  // 5.7 degrees off
  const auto colour = [&](const VisibilityRules& rules) {
    return scene_of(g, rules).triangles.at(0).colour;
  };
  VisibilityRules lenient;
  lenient.grades = {0.2, 0.4, 0.1, 0.2};
  EXPECT_EQ(colour({}).g, look::colours().poor.g);
  EXPECT_EQ(colour(lenient).g, look::colours().fair.g) << "never green where nobody is sure";
}

std::string readout(const render::Scene& scene) {
  for (const render::TextItem& text : scene.texts) {
    if (kind_of(text.label) == kAngle) {
      return text.runs.at(0).text;
    }
  }
  return "absent";
}

/// What the target cross is drawn of.
std::vector<std::pair<render::Label, std::string>> cross(const render::Scene& scene) {
  std::vector<std::pair<render::Label, std::string>> items;
  for (const render::MeshItem& mesh : scene.meshes) {
    if (kind_of(mesh.label) == kCross) {
      items.emplace_back(mesh.label, "surface");
    }
  }
  for (const render::LineItem& line : scene.lines) {
    if (kind_of(line.label) == kCross) {
      items.emplace_back(line.label, "line");
    }
  }
  for (const render::TextItem& text : scene.texts) {
    if (kind_of(text.label) == kCross) {
      items.emplace_back(text.label, text.runs.at(0).text);
    }
  }
  return items;
}

TEST_F(Guiding, WhatIsDrawnTooLateLosesTriangleAndNumber) {
  SceneBuilder builder;
  render::Scene scene;
  const Guidance& g = s.pair();
  builder.update(g);
  builder.write_scene(g, scene);
  ASSERT_FALSE(scene.triangles.empty());
  hide_tool_guidance(scene);
  EXPECT_TRUE(scene.triangles.empty());
  for (const render::LineItem& line : scene.lines) {
    EXPECT_NE(kind_of(line.label), kTriangle);
  }
  render::Scene late;
  builder.update(g, g.tool->pose_time + g.stale_after + Duration(1));
  builder.write_scene(g, late);
  EXPECT_EQ(readout(scene), readout(late));
  EXPECT_EQ(cross(scene), cross(late));
  EXPECT_EQ(cross(late).back().second, "tool lost");
}

}  // namespace
}  // namespace orthonav::engine::scene_builder_test
