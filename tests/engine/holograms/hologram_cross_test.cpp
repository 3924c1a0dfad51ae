#include "engine/holograms/hologram_cross.h"

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
    cross.reading = CrossReading{0.002f * render::unit_or(across, {}), {}, Grade::kGood};
    const CrossPlaces places = places_of(cross);
    const Float3 moved = places.dots[0] - places.middle;
    EXPECT_NEAR(render::length(moved), kCrossScale * 0.002f, kRounding_m);
    EXPECT_GT(dot(moved, places.right), 0.9f * kCrossScale * 0.002f) << outward.x;
    EXPECT_NEAR(render::length(places.dots[1] - places.middle), 0.0f, kRounding_m);
  }
}

TEST(TargetCross, ADotPastTheRimStaysThereAndPointsOut) {
  TargetCross cross = over_origin();
  cross.reading = CrossReading{{0.030f, 0, 0}, {0.004f, 0, 0}, Grade::kPoor};
  const CrossPlaces places = places_of(cross);
  EXPECT_TRUE(places.outside[0]);
  EXPECT_FALSE(places.outside[1]);
  EXPECT_LT(render::length(places.dots[0] - places.middle), 1.2f * kCrossScale * 0.005f);
  cross.reading->tip_offset.x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(places_of(cross).outside[0]);
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
  cross.reading = CrossReading{{0.001f, 0, 0}, {0.002f, 0, 0}, Grade::kGood};
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

TEST(Depth, IsPalerAndSmallerWithItsSdWhereItIsNotSure) {
  render::Scene scene;
  add_depth(scene, {}, {0, 0.08f, 0}, {nav::DepthTo::kTarget, 310, 4, true}, 7);
  add_depth(scene, {}, {0, 0.08f, 0}, {nav::DepthTo::kPastTarget, 12, 14, false}, 8);
  ASSERT_EQ(scene.texts.size(), 2u);
  const render::TextItem& sure = scene.texts[0];
  const render::TextItem& unsure = scene.texts[1];
  EXPECT_EQ(sure.runs.at(0).text, "31.0 mm to target");
  EXPECT_EQ(unsure.runs.at(0).text, "1.2 ± 1.4 mm past target");
  EXPECT_LT(unsure.height_m, sure.height_m);
  EXPECT_LT(unsure.runs[0].colour.g, sure.runs[0].colour.g);
  EXPECT_EQ(sure.rim.a, 0.0f);
  EXPECT_GT(unsure.rim.a, 0.0f);
}

}  // namespace
}  // namespace orthonav::engine
