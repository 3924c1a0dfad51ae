#include "nav/calibration/tag_body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "nav/calibration/body_adjustment.h"
#include "nav/calibration/pose_mean.h"
#include "tests/support/tag_body_scene.h"

namespace orthonav::nav::tag_body_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;

std::vector<PairSightings> seen(const test::TagBodyScene& scene, int pairs, std::uint64_t seed) {
  Random random(seed);
  std::vector<PairSightings> all;
  for (const auto& pose : test::turning(pairs)) {
    all.push_back(scene.seen(pose, random));
  }
  return all;
}

Result<TagBody> calibrated(const test::TagBodyScene& scene, std::span<const PairSightings> pairs,
                           const TagBodyOptions& options = {}) {
  return calibrate_tag_body(scene.calibration, scene.tags, pairs, options);
}

std::string refusal(const test::TagBodyScene& scene, std::span<const PairSightings> pairs,
                    const TagBodyOptions& options = {}) {
  const auto body = calibrated(scene, pairs, options);
  return body ? std::string() : body.error().message;
}

double translation_off_m(const BodyTag& tag, const Transform<Marker, Tag>& truth) {
  return (tag.marker_from_tag.translation() - truth.translation()).norm();
}

double rotation_off_rad(const BodyTag& tag, const Transform<Marker, Tag>& truth) {
  return rotation_angle_rad(tag.marker_from_tag.rotation(), truth.rotation());
}

TEST(TagBody, FindsThePosesExactlyWithoutNoise) {
  test::TagBodyScene scene = test::prism();
  scene.noise_px = 0.0;
  const auto body = calibrated(scene, seen(scene, 120, 1));
  ASSERT_TRUE(body.ok()) << body.error().message;
  ASSERT_THAT(body->tags, SizeIs(3));
  EXPECT_EQ(body->tags[0].marker_from_tag, (Transform<Marker, Tag>{}));
  for (std::size_t i = 1; i < 3; ++i) {
    // The camera's table is inverted to 1e-6 px.
    EXPECT_LT(translation_off_m(body->tags[i], scene.marker_from_tag[i]), 1e-7);
    EXPECT_LT(rotation_off_rad(body->tags[i], scene.marker_from_tag[i]), 1e-6);
  }
  EXPECT_LT(body->rms_px, 1e-4);
  EXPECT_EQ(body->judgement.verdict, Verdict::kPass) << body->judgement.reason;
}

TEST(TagBody, PredictsItsOwnErrors) {
  const test::TagBodyScene scene = test::prism();
  double translation = 0.0;
  double translation_sigma = 0.0;
  double rotation = 0.0;
  double rotation_sigma = 0.0;
  constexpr int kTrials = 15;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto body = calibrated(scene, seen(scene, 60, static_cast<std::uint64_t>(50 + trial)));
    ASSERT_TRUE(body.ok()) << body.error().message;
    // Of forty numbers a pair, six are fitted: 8 % less than the noise.
    EXPECT_NEAR(body->rms_px, 0.92 * scene.noise_px * std::sqrt(2.0), 0.003);
    for (std::size_t i = 1; i < 3; ++i) {
      translation += std::pow(translation_off_m(body->tags[i], scene.marker_from_tag[i]), 2);
      rotation += std::pow(rotation_off_rad(body->tags[i], scene.marker_from_tag[i]), 2);
      translation_sigma += std::pow(body->tags[i].sigma_m, 2);
      rotation_sigma += std::pow(body->tags[i].sigma_rad, 2);
    }
  }
  // 90 numbers: the ratio of variances lies within 45 % (3 SD); the larger of two estimates is
  // told.
  EXPECT_GT(translation / translation_sigma, 0.4);
  EXPECT_LT(translation / translation_sigma, 1.3);
  EXPECT_GT(rotation / rotation_sigma, 0.4);
  EXPECT_LT(rotation / rotation_sigma, 1.3);
}

TEST(TagBody, BearsTagsThatWereSeenWrongly) {
  const test::TagBodyScene scene = test::prism();
  auto pairs = seen(scene, 80, 3);
  const TagGeometry geometry(scene.calibration);
  for (std::size_t i = 0; i < pairs.size(); i += 6) {
    for (TagSighting& sighting : pairs[i]) {
      if (sighting.tag != 1 || !sighting.pose) {
        continue;
      }
      for (Vec2& corner : *sighting.left_px) {
        corner = corner + Vec2{4.0, 3.0};
      }
      sighting.pose = geometry.pose({*sighting.left_px, *sighting.right_px}, 0.04);
    }
  }
  const auto body = calibrated(scene, pairs);
  ASSERT_TRUE(body.ok()) << body.error().message;
  EXPECT_GT(body->outlier_fraction, 0.01);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_LT(translation_off_m(body->tags[i], scene.marker_from_tag[i]), 0.0001);
  }
}

TEST(TagBody, ConnectsTagsThroughOthers) {
  // 4 and 5 never meet, 3 meets both.
  const test::TagBodyScene scene = test::prism();
  auto pairs = seen(scene, 80, 4);
  for (PairSightings& pair : pairs) {
    if (pair.size() == 3) {
      pair.pop_back();
    }
  }
  const auto body = calibrated(scene, pairs);
  ASSERT_TRUE(body.ok()) << body.error().message;
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_LT(translation_off_m(body->tags[i], scene.marker_from_tag[i]), 0.0002);
  }
}

TEST(TagBody, NamesTagsThatNothingConnects) {
  const test::TagBodyScene scene = test::prism();
  auto pairs = seen(scene, 80, 5);
  for (PairSightings& pair : pairs) {
    if (pair.size() > 1) {
      std::erase_if(pair, [](const TagSighting& s) { return s.tag == 2; });
    }
  }
  EXPECT_THAT(refusal(scene, pairs),
              AllOf(HasSubstr("tag tag36h11 id 5 (seen in"), HasSubstr("not seen in 10 pairs"),
                    HasSubstr("connect it with tag tag36h11 id 3")));
  EXPECT_THAT(refusal(scene, {}), AllOf(HasSubstr("id 4 (seen in 0 pairs), tag tag36h11 id 5")));
}

TEST(TagBody, RefusesTagsThatMoveAgainstEachOther) {
  test::TagBodyScene scene = test::prism();
  const Transform<Marker, Tag> at_rest = scene.marker_from_tag[1];
  Random random(6);
  std::vector<PairSightings> pairs;
  for (const auto& pose : test::turning(80)) {
    pairs.push_back(scene.seen(pose, random));
    // The second tag hangs on a spring of 1.5 mm.
    scene.marker_from_tag[1] = {
        at_rest.rotation(),
        at_rest.translation() + Vec3{random.normal(0, 1.5e-3), random.normal(0, 1.5e-3), 0}};
  }
  EXPECT_THAT(refusal(scene, pairs), HasSubstr("do the tags move against each other?"));
}

TEST(TagBody, RefusesASizeThatTheImagesContradict) {
  test::TagBodyScene scene = test::prism();
  const auto pairs = seen(scene, 40, 7);
  // 36 mm are given for all of them; by the corners it is 40.
  auto wrong = pairs;
  const TagGeometry geometry(scene.calibration);
  for (PairSightings& pair : wrong) {
    for (TagSighting& s : pair) {
      if (s.pose) {
        s.pose = geometry.pose({*s.left_px, *s.right_px}, 0.036);
      }
    }
  }
  for (MarkerDefinition& tag : scene.tags) {
    tag.size_m = 0.036;
  }
  EXPECT_THAT(refusal(scene, wrong), HasSubstr("id 3: its edges measure 40."));
  TagBodyOptions lenient;
  lenient.max_size_deviation = 0.2;
  EXPECT_THAT(refusal(scene, wrong, lenient), Not(HasSubstr("edges"))) << "that limit alone";
}

TEST(TagBody, RefusesBadInput) {
  test::TagBodyScene scene = test::prism();
  const auto pairs = seen(scene, 20, 8);
  EXPECT_THAT(
      calibrate_tag_body(scene.calibration, std::span(scene.tags).first(1), pairs).error().message,
      HasSubstr("1 tag, at least 2"));
  EXPECT_FALSE(calibrate_tag_body(scene.calibration, {}, pairs).ok());
  scene.tags[2].id = 3;
  EXPECT_THAT(refusal(scene, pairs), HasSubstr("id 3 is already on"));
  scene.tags[2] = {"tag99h1", 5, 0.04};
  EXPECT_THAT(refusal(scene, pairs), HasSubstr("tag99h1"));
}

TEST(MedianPose, HardlyMovesWithAThirdOfThemWrong) {
  Random random(9);
  const Transform<Tag, Tag> truth(rotation_from_vector({0.2, 1.1, -0.4}), {0.03, -0.01, 0.02});
  std::vector<Transform<Tag, Tag>> poses;
  Vec3 mean;
  for (int i = 0; i < 90; ++i) {
    const bool wrong = i % 3 == 0;
    const double rotation = wrong ? 0.8 : 0.01;
    const double translation = wrong ? 0.05 : 0.0002;
    poses.emplace_back(
        rotation_from_vector(
            {random.normal(0, rotation), rotation * (wrong ? 1 : 0), random.normal(0, rotation)}) *
            truth.rotation(),
        truth.translation() + Vec3{random.normal(0, translation), wrong ? translation : 0, 0});
    mean += poses.back().translation() / 90.0;
  }
  const Transform<Tag, Tag> found = median_pose(poses);
  EXPECT_LT((found.translation() - truth.translation()).norm(), 0.0005);
  EXPECT_LT(rotation_angle_rad(found.rotation(), truth.rotation()), 0.02);
  EXPECT_GT((mean - truth.translation()).norm(), 0.005) << "the plain mean is dragged away";
}

}  // namespace
}  // namespace orthonav::nav::tag_body_test
