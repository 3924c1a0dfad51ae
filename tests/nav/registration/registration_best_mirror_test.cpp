// Registration `best` on mirror images and on bones that look the same from two sides.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "tests/nav/registration/register_best.h"
#include "tests/support/slab_bone.h"
#include "tests/support/stroke_truths.h"

namespace orthonav::nav::registration_best_test {
namespace {

using test::digitize_strokes;
using test::kinds_of;
using test::StrokeVariant;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

TEST_F(RegisterBest, RefusesTheMirrorImageOfTheModelAndOfThePoints) {
  TriangleMesh crooked = l4().from.mesh;
  for (Vec3& v : crooked.vertices_m) {
    v.z += 0.12 * v.x;  // no vertebra is its own mirror image
    v.x *= v.x > 0.0 ? 1.08 : 1.0;
  }
  const auto strokes = digitize_strokes(crooked, StrokeVariant::kFull, 3).value();
  const auto right = VertebraModel::prepare(crooked).value();
  const auto own = register_by_pose_search(*right, strokes.tips(), options(l4()));
  ASSERT_TRUE(own.ok());
  EXPECT_THAT(kinds_of(*own), Not(Contains(RefusalReason::Kind::kMirrored)));
  EXPECT_LT(own->mirror_log_likelihood, -10.0);
  const auto wrong = VertebraModel::prepare(orthonav::test::mirrored(crooked)).value();
  const auto r = register_by_pose_search(*wrong, strokes.tips(), options(l4()));
  ASSERT_TRUE(r.ok());
  EXPECT_FALSE(r->accepted);
  EXPECT_THAT(kinds_of(*r), Contains(RefusalReason::Kind::kMirrored));
  Points left_handed = strokes.tips();
  for (Point<World>& p : left_handed) {
    p.v.x = -p.v.x;
  }
  const auto l = register_by_pose_search(*right, left_handed, options(l4()));
  EXPECT_TRUE(!l.ok() || !l->accepted);
}

/// A fit that mirrored would leave the strokes' own noise; the best proper turn of this phantom,
/// which is nearly its own mirror image, leaves 2.1 times as much. In between:
constexpr double kNotItsOwnMirror = 1.5;
/// The same strokes in other frames: the last step of a fit is a hundredth of the noise.
constexpr double kSameFit = 0.02;

TEST_F(RegisterBest, NeverMirrorsToFit) {
  using Kind = RefusalReason::Kind;
  const double own_noise_m = registered(full_.tips()).value().noise_m;
  const auto mirror_model = VertebraModel::prepare(orthonav::test::mirrored(l4().from.mesh));
  ASSERT_TRUE(mirror_model.ok());
  for (const int axis : {0, 1, 2}) {
    Points mirrored = full_.tips();
    for (Point<World>& p : mirrored) {
      p.v[axis] = -p.v[axis];
    }
    const auto r = registered(mirrored);
    ASSERT_TRUE(r.ok()) << r.error().message;
    EXPECT_NEAR(r->world_from_vertebra.rotation().determinant(), 1.0, 1e-9);
    EXPECT_NEAR(r->runner_up.rotation().determinant(), 1.0, 1e-9);
    EXPECT_GT(r->noise_m, kNotItsOwnMirror * own_noise_m) << "axis " << axis;
    EXPECT_THAT(kinds_of(*r), ElementsAre(Kind::kMirrored)) << "axis " << axis;
    // The control: the result of a mirrored fit, which is accepted and exceeds the bound.
    const auto fitted = register_by_pose_search(**mirror_model, mirrored, {});
    ASSERT_TRUE(fitted.ok()) << fitted.error().message;
    EXPECT_TRUE(fitted->accepted) << "axis " << axis;
    EXPECT_NEAR(fitted->noise_m / own_noise_m, 1.0, kSameFit) << "axis " << axis;
  }
}

/// A verdict on noisy strokes over the back of a box-like bone, which may be mirrored.
Registration slab_verdict(double (*back)(double, double), bool mirrored) {
  const auto model = VertebraModel::prepare(test::slab_bone(back)).value();
  Random random(5);
  Points points;
  for (Vec3 p : test::strokes_over(model->surface(), 14)) {
    p += Vec3{random.normal(0, 0.0003), random.normal(0, 0.0003), random.normal(0, 0.0003)};
    points.push_back({{mirrored ? -p.x : p.x, p.y, p.z}});
  }
  return register_by_pose_search(*model, points).value();
}

TEST_F(RegisterBest, RefusesABoneThatLooksTheSameFromTwoSides) {
  const Registration twofold = slab_verdict(test::twofold_back, false);
  EXPECT_FALSE(twofold.accepted);
  EXPECT_THAT(kinds_of(twofold), Contains(RefusalReason::Kind::kLogLikelihoodRatio));
  EXPECT_LT(std::abs(twofold.log_likelihood_ratio), 6.0);
  // The rival is the other pose, half a turn away.
  EXPECT_NEAR(
      rotation_angle_rad(twofold.runner_up.rotation(), twofold.world_from_vertebra.rotation()),
      std::acos(-1.0), 0.02);
  // The same strokes on a bone without the symmetry are accepted, so the symmetry alone was
  // refused.
  const Registration crooked = slab_verdict(test::crooked_back, false);
  EXPECT_TRUE(crooked.accepted) << crooked.reasons.size() << " reasons";
}

/// The few points by which candidates are compared favour the wrong pose, all points together the
/// right one, which then takes its place.
TEST_F(RegisterBest, SwapsInARunnerUpThatIsBetter) {
  constexpr std::size_t kFew = 300;  // one in this many is looked at first
  const auto model = VertebraModel::prepare(test::slab_bone(test::crooked_back)).value();
  Random random(5);
  std::vector<Vec3> places = test::strokes_over(model->surface(), 14);
  const std::vector<Vec3> once = places;
  while (places.size() < 6 * kFew) {
    places.insert(places.end(), once.begin(), once.end());
  }
  const std::size_t step = places.size() / kFew;
  const Mat3 half_turn = rotation_from_vector({0.0, std::acos(-1.0), 0.0});
  const auto points_of = [&](std::size_t first, std::size_t every) {
    Points points;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool rotated = i % every == first;
      const Vec3 noise{random.normal(0, 0.0003), random.normal(0, 0.0003),
                       random.normal(0, 0.0003)};
      points.push_back({(rotated ? half_turn * places[i] : places[i]) + noise});
    }
    return points;
  };
  // The control: equally many points that are equally wrong, but none of them among the few.
  for (const std::size_t first : {std::size_t{0}, step - 1}) {
    const auto r = register_by_pose_search(*model, points_of(first, step)).value();
    EXPECT_LT(rotation_angle_rad(r.world_from_vertebra.rotation(), Mat3::identity()), 0.02)
        << first;
    EXPECT_GT(r.log_likelihood_ratio, 0.0) << first;
  }
}

TEST_F(RegisterBest, RefusesTheMirrorImageOfACrookedBone) {
  const Registration mirrored = slab_verdict(test::crooked_back, true);
  EXPECT_FALSE(mirrored.accepted) << "noise " << mirrored.noise_m << " margin "
                                  << mirrored.log_likelihood_ratio;
  EXPECT_NEAR(mirrored.world_from_vertebra.rotation().determinant(), 1.0, 1e-9);
}

}  // namespace
}  // namespace orthonav::nav::registration_best_test
