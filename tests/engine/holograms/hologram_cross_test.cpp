#include "engine/holograms/shapes/hologram_cross.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "render/float3.h"

namespace orthonav::engine {
namespace {

using render::Float3;

constexpr float kRounding_m = 1e-6f;

/// Eyes right above a site in the origin, the head's up along -z: the patient lies along z.
TargetCross over_origin() {
  TargetCross cross;
  cross.outward = {0, 1, 0};
  cross.viewer = {{0, 0.45f, 0}, {0, 0, -1}};
  return cross;
}

TEST(TargetCross, HangsAboveTheSiteAsTheEyesSeeItAndAside) {
  const CrossPlaces left = places_of(over_origin());
  EXPECT_NEAR(left.middle.x, -kCrossAside_m, kRounding_m);
  EXPECT_NEAR(left.middle.z, -kCrossAbove_m, kRounding_m);
  TargetCross other = over_origin();
  other.side = LabelSide::kRight;
  EXPECT_NEAR(places_of(other).middle.x, kCrossAside_m, kRounding_m);
}

TEST(TargetCross, FacesTheEyes) {
  const TargetCross cross = over_origin();
  const CrossPlaces places = places_of(cross);
  const Float3 normal = render::cross(places.right, places.up);
  const Float3 to_eye = render::unit_or(cross.viewer.eye - places.middle, {});
  EXPECT_NEAR(render::dot(normal, to_eye), 1.0f, 1e-5f);
}

TEST(TargetCross, WhatMovesToTheRightMovesItsDotToTheRight) {
  for (const Float3 outward : {Float3{0, 1, 0}, Float3{0.5f, 0.8f, 0.2f}, Float3{0, -1, 0}}) {
    TargetCross cross = over_origin();
    cross.outward = render::unit_or(outward, {});
    const Float3 right = {1, 0, 0};
    const Float3 across = right - dot(right, cross.outward) * cross.outward;
    cross.reading =
        CrossReading{0.002f * render::unit_or(across, {}), {}, Grade::kGood, Worst::kNothing};
    const CrossPlaces places = places_of(cross);
    const Float3 moved = places.dots[0] - places.middle;
    EXPECT_NEAR(render::length(moved), kCrossScale * 0.002f, kRounding_m);
    EXPECT_GT(dot(moved, places.right), 0.9f * kCrossScale * 0.002f) << outward.x;
    EXPECT_NEAR(render::length(places.dots[1] - places.middle), 0.0f, kRounding_m);
  }
}

TEST(TargetCross, ADotPastTheRimStaysThere) {
  TargetCross cross = over_origin();
  cross.reading = CrossReading{{0.030f, 0, 0}, {0.004f, 0, 0}, Grade::kPoor, Worst::kNothing};
  const CrossPlaces places = places_of(cross);
  EXPECT_NEAR(render::length(places.dots[0] - places.middle), 1.12f * kCrossScale * 0.005f, 1e-5f);
  EXPECT_NEAR(render::length(places.dots[1] - places.middle), kCrossScale * 0.004f, 1e-5f);
  EXPECT_FALSE(places.way);
  cross.reading->tip_offset.x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_LT(render::length(places_of(cross).dots[0] - places.middle), 0.03f);
}

TEST(TargetCross, TheWayLeadsTheTipToTheMiddleAndTheAxisToTheTip) {
  TargetCross cross = over_origin();
  cross.reading = CrossReading{{0.002f, 0, 0}, {0.001f, 0, 0.004f}, Grade::kPoor, Worst::kOffset};
  const CrossPlaces of_tip = places_of(cross);
  ASSERT_TRUE(of_tip.way);
  EXPECT_EQ((*of_tip.way)[0], of_tip.dots[0]);
  EXPECT_NEAR(render::length((*of_tip.way)[1] - of_tip.middle), 0.0f, 1e-5f);
  cross.reading->worst = Worst::kAngle;
  const CrossPlaces of_axis = places_of(cross);
  ASSERT_TRUE(of_axis.way);
  const Float3 way = (*of_axis.way)[1] - (*of_axis.way)[0];
  EXPECT_EQ((*of_axis.way)[0], of_axis.dots[1]);
  EXPECT_GT(dot(render::unit_or(way, {}), render::unit_or(of_axis.dots[0] - of_axis.dots[1], {})),
            0.999f);
}

TEST(TargetCross, TakesTheSideThatThePlanDoesNotLeanTo) {
  const Viewer viewer = over_origin().viewer;
  const auto side = [&](float lean, LabelSide until_now) {
    return clear_side({}, render::unit_or({lean, 1, 0}, {}), viewer, until_now);
  };
  EXPECT_EQ(side(0.4f, LabelSide::kRight), LabelSide::kLeft);
  EXPECT_EQ(side(-0.4f, LabelSide::kLeft), LabelSide::kRight);
  for (const LabelSide kept : {LabelSide::kLeft, LabelSide::kRight}) {
    EXPECT_EQ(side(0.05f, kept), kept) << "hardly leans";
  }
}

TEST(TargetCross, TakenOffItsDotsItSaysWhatALostOneSays) {
  TargetCross cross = over_origin();
  cross.reading = CrossReading{{0.001f, 0, 0}, {0.002f, 0, 0}, Grade::kGood, Worst::kNothing};
  render::Scene scene;
  add_target_cross(scene, cross, 701);
  take_dots_off(scene, 701);
  cross.reading.reset();
  cross.lost = true;
  render::Scene lost;
  add_target_cross(lost, cross, 701);
  ASSERT_EQ(scene.lines.size(), lost.lines.size());
  ASSERT_EQ(scene.texts.size(), lost.texts.size());
  EXPECT_EQ(scene.texts[0].runs[0].text, "tool lost");
  EXPECT_NEAR(render::length(scene.texts[0].position - lost.texts[0].position), 0.0f, 1e-5f);
  EXPECT_TRUE(scene.meshes.empty());
}

render::Scene written(const CrossNumbers& numbers) {
  render::Scene scene;
  add_cross_numbers(scene, over_origin(), numbers, {601, 1306, 901});
  return scene;
}

TEST(CrossNumbers, AreThreeOfWhichOnlyTheWorstHasARim) {
  CrossNumbers numbers;
  numbers.sizes = nav::ScrewSizes{{12, nav::Certainty::kSure}, {31, nav::Certainty::kSure}};
  numbers.depth = nav::ShownDepth{nav::DepthTo::kTarget, 310, nav::Certainty::kSure};
  for (const auto& [worst, bright] : {std::pair{Worst::kNothing, 3U},
                                      {Worst::kAngle, 0U},
                                      {Worst::kOffset, 1U},
                                      {Worst::kDepth, 2U}}) {
    numbers.worst = worst;
    const render::Scene scene = written(numbers);
    ASSERT_EQ(scene.texts.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(scene.texts[i].rim.a > 0, i == bright) << i;
    }
  }
}

TEST(CrossNumbers, MarkWhichOfThemAreBounds) {
  CrossNumbers numbers;
  numbers.sizes = nav::ScrewSizes{{12, nav::Certainty::kSure}, {26, nav::Certainty::kBound}};
  numbers.worst = Worst::kCertainty;
  const render::Scene scene = written(numbers);
  ASSERT_EQ(scene.texts.size(), 2u) << "no depth";
  EXPECT_EQ(scene.texts[0].rim.a, 0.0f);
  EXPECT_GT(scene.texts[1].rim.a, 0.0f);
  EXPECT_EQ(scene.texts[1].runs.at(0).text, "tip ≤ 2.6 mm");
}

TEST(CrossNumbers, FillTheBarAsTheTipAdvances) {
  const auto filled_m = [](float way) {
    CrossNumbers numbers;
    numbers.sizes.emplace();
    numbers.depth.emplace();
    numbers.way = way;
    const render::Scene scene = written(numbers);
    return scene.triangles.empty()
               ? 0.0f
               : render::length(scene.triangles[0].corners[2] - scene.triangles[0].corners[1]);
  };
  EXPECT_EQ(filled_m(0.0f), 0.0f);
  EXPECT_NEAR(filled_m(0.5f), 0.020f, 1e-5f);
  EXPECT_NEAR(filled_m(1.0f), 0.040f, 1e-5f);
}

TEST(CrossNumbers, AreDashesWithoutAMeasurement) {
  const render::Scene scene = written({});
  ASSERT_EQ(scene.texts.size(), 1u);
  EXPECT_EQ(scene.texts[0].runs.at(0).text, "\u2012\u2012.\u2012°");
  EXPECT_EQ(scene.texts[0].rim, look::colours().poor);
}

}  // namespace
}  // namespace orthonav::engine
