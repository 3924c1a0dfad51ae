#include "nav/calibration/tag_mounting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/tag_body_scene.h"

namespace orthonav::nav {
namespace {

using ::testing::IsEmpty;

Mat3 about_z(int quarters) { return rotation_from_vector({0, 0, quarters * std::numbers::pi / 2}); }

/// The prism, with tag number i turned `turns[i]` times on its face, as a calibration would find
/// it; built by hand, so two degrees and millimetres off its description.
std::vector<BodyTag> mounted(const test::TagBodyScene& scene, const std::vector<int>& turns) {
  const Mat3 off = rotation_from_vector({0.02, -0.03, 0.01});
  std::vector<BodyTag> body;
  for (std::size_t i = 0; i < scene.tags.size(); ++i) {
    const Transform<Marker, Tag>& at = scene.marker_from_tag[i];
    BodyTag tag;
    tag.definition = scene.tags[i];
    if (i > 0) {
      tag.marker_from_tag = {about_z(-turns[0]) * at.rotation() * off * about_z(turns[i]),
                             about_z(-turns[0]) * (at.translation() + Vec3{0.002, 0, -0.001})};
    }
    body.push_back(tag);
  }
  return body;
}

std::vector<AttachedMarker> described(const test::TagBodyScene& scene) {
  std::vector<AttachedMarker> out;
  for (std::size_t i = 1; i < scene.tags.size(); ++i) {
    out.push_back({scene.tags[i], scene.marker_from_tag[i]});
  }
  return out;
}

TEST(TagMounting, FindsEveryQuarterTurnOfEveryTag) {
  const test::TagBodyScene scene = test::prism();
  for (int first = 0; first < 4; ++first) {
    for (int second = 0; second < 4; ++second) {
      for (int third = 0; third < 4; ++third) {
        const std::vector<int> turns = {first, second, third};
        std::vector<int> found(3, 0);
        for (const RotatedTag& tag : rotated_tags(mounted(scene, turns), described(scene))) {
          found[static_cast<std::size_t>(tag.definition.id - 3)] = tag.quarter_turns;
        }
        EXPECT_EQ(found, turns);
      }
    }
  }
}

TEST(TagMounting, SaysNothingOfTagsThatTheDescriptionLacks) {
  const test::TagBodyScene scene = test::prism();
  EXPECT_THAT(rotated_tags(mounted(scene, {0, 1, 2}), {}), IsEmpty());
  const auto both = described(scene);
  const auto found = rotated_tags(mounted(scene, {0, 1, 2}), std::span(both).first(1));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].definition.id, 4);
}

TEST(TagMounting, SaysNothingOfAnotherLayout) {
  const test::TagBodyScene scene = test::prism();
  auto layout = described(scene);
  for (AttachedMarker& tag : layout) {
    tag.marker_from_tag = {tag.marker_from_tag.rotation(),
                           tag.marker_from_tag.translation() + Vec3{0, 0.08, 0}};
  }
  EXPECT_THAT(rotated_tags(mounted(scene, {0, 1, 0}), layout), IsEmpty());
}

/// With one tag behind the other, turns of the marker and of the tag look alike.
TEST(TagMounting, BlamesTheOtherTagWhereTheMarkersAxisGoesThroughIt) {
  test::TagBodyScene scene = test::prism();
  scene.tags.resize(2);
  scene.marker_from_tag.resize(2);
  scene.marker_from_tag[1] = {rotation_from_vector({0, std::numbers::pi, 0}), {0, 0, -0.02}};
  const auto found = rotated_tags(mounted(scene, {0, 1}), described(scene));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].definition.id, 4);
  EXPECT_EQ(found[0].quarter_turns, 1);
}

}  // namespace
}  // namespace orthonav::nav
