// Registration `best` on strokes that it must refuse, and its reasons.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "nav/registration/decision.h"
#include "tests/nav/registration/register_best.h"
#include "tests/support/stroke_truths.h"

namespace orthonav::nav::registration_best_test {
namespace {

using test::digitize_strokes;
using test::kinds_of;
using test::StrokeVariant;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST_F(RegisterBest, RefusesAModelOfAnotherSizeAndSaysSo) {
  for (const double factor : {0.9, 0.97, 1.03, 1.1}) {
    const auto model = VertebraModel::prepare(orthonav::test::scaled(l4().from.mesh, factor));
    ASSERT_TRUE(model.ok());
    const auto r = register_by_pose_search(**model, full_.tips(), options(l4()));
    if (!r) {
      continue;
    }
    EXPECT_FALSE(r->accepted) << factor;
    EXPECT_THAT(kinds_of(*r), Contains(RefusalReason::Kind::kModelSize)) << factor;
    EXPECT_NEAR(r->size, 1.0 / factor, 0.3 * std::abs(1.0 / factor - 1.0)) << factor;
  }
}

TEST_F(RegisterBest, RefusesAPoseAtWhichThePointerGoesThroughBone) {
  const Points tips = full_.tips();
  const auto vertebra_from_world = full_.world_from_vertebra.inverse();
  PoseSearchRegistrationOptions o = options(l4());
  for (const Point<World>& tip : tips) {
    const auto on_bone = l4().model->surface().nearest((vertebra_from_world * tip).v);
    o.shafts.push_back(full_.world_from_vertebra.rotation() *
                       (on_bone->normal + Vec3{0.0, 1.0, 0.0}).normalized());
  }
  const auto through_bone = [&](std::span<const Vec3> shafts) {
    return posterior::shaft_collision_fraction(posterior::observed(tips, 0.0, shafts), *l4().model,
                                               full_.world_from_vertebra);
  };
  EXPECT_LT(through_bone(o.shafts), 0.1);
  const auto held = register_by_pose_search(*l4().model, tips, o).value();
  EXPECT_TRUE(held.accepted) << held.reasons.size() << " reasons";
  EXPECT_LT(held.shaft_collision_fraction, 0.1);
  // As if the bone had been touched from within.
  for (Vec3& shaft : o.shafts) {
    shaft = -shaft;
  }
  const auto through = register_by_pose_search(*l4().model, tips, o).value();
  EXPECT_FALSE(through.accepted);
  EXPECT_THAT(kinds_of(through), Contains(RefusalReason::Kind::kShaftCollision));
  // Without known shafts, no reason mentions them.
  EXPECT_EQ(through_bone({}), 0.0);
  const std::vector<Vec3> unknown(tips.size());
  EXPECT_EQ(through_bone(unknown), 0.0);
}

TEST_F(RegisterBest, NamesTheLevelThatWasStrokedInstead) {
  for (const auto& [stroked, asked] : {std::pair{"L3", "L4"}, {"L5", "L4"}, {"L4", "L3"}}) {
    const auto strokes =
        digitize_strokes(level(stroked).from.mesh, StrokeVariant::kFull, 7).value();
    const auto r = register_by_pose_search(*level(asked).model, strokes.tips(),
                                           options(level(asked), {stroked}));
    ASSERT_TRUE(r.ok()) << r.error().message;
    EXPECT_FALSE(r->accepted) << stroked << " on " << asked;
    EXPECT_EQ(r->fits_better, stroked);
    EXPECT_THAT(kinds_of(*r), ElementsAre(RefusalReason::Kind::kFitsOtherLevel));
    EXPECT_EQ(r->reasons.front().level, stroked);
  }
}

TEST_F(RegisterBest, RefusesWhatIsNoBone) {
  Random random(31);
  Points ball, plane, cylinder;
  for (int i = 0; i < 1500; ++i) {
    const Vec3 v{random.normal(), random.normal(), random.normal()};
    ball.push_back({0.03 / v.norm() * v});
    plane.push_back({{random.uniform(-0.03, 0.03), random.uniform(-0.02, 0.02), 0.0}});
    const double around = random.uniform(0.0, 3.0);
    cylinder.push_back(
        {{0.015 * std::cos(around), 0.015 * std::sin(around), random.uniform(-0.03, 0.03)}});
  }
  expect_refused(ball, "a ball");
  expect_refused(plane, "a plane");
  expect_refused(cylinder, "half a cylinder");
  // The control: equally many points on the bone are refused for none of these reasons.
  const Points tips = full_.tips();
  ASSERT_GE(tips.size(), 1500u);
  const auto bone = registered(Points(tips.begin(), tips.begin() + 1500));
  ASSERT_TRUE(bone.ok()) << bone.error().message;
  EXPECT_THAT(bone->reasons, IsEmpty());
}

TEST_F(RegisterBest, RefusesBadInputInOneLine) {
  const auto refused = [](const Points& points) {
    const auto r = registered(points);
    return r ? std::string("registered") : r.error().message;
  };
  const Points tips = full_.tips();
  EXPECT_THAT(refused({}), HasSubstr("0 points"));
  EXPECT_THAT(refused(Points(tips.begin(), tips.begin() + 2)), HasSubstr("2 points"));
  EXPECT_THAT(refused(Points(tips.begin(), tips.begin() + 99)), HasSubstr("at least 100"));
  EXPECT_THAT(refused(Points(3000, tips[0])), HasSubstr("in one place"));
  Points line;
  for (int i = 0; i < 500; ++i) {
    line.push_back({{0.0001 * i, 0.0002 * i, 1.0}});
  }
  EXPECT_THAT(refused(line), HasSubstr("on a line"));
  for (const double strange : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Points broken = tips;
    broken[17].v.z = strange;
    EXPECT_THAT(refused(broken), HasSubstr("point 18 is not finite"));
  }
  Points in_millimetres = tips;
  for (Point<World>& p : in_millimetres) {
    p.v = 1e3 * p.v;
  }
  EXPECT_THAT(refused(in_millimetres), HasSubstr("unit"));
}

/// The next strokes lie within this distance of the named part.
constexpr double kAround_m = 0.010;

TEST_F(RegisterBest, RefusesTooSmallAPartAndSaysWhatToStroke) {
  using Kind = RefusalReason::Kind;
  // The tip of the spinous process alone.
  Points stroked;
  const double hind_m = bounds_of(l4().model->mesh()).high.y;
  for (const auto& s : full_.samples) {
    if (s.true_tip.v.y > hind_m - 0.012) {
      stroked.push_back(s.tip);
    }
  }
  ASSERT_GE(stroked.size(), kFewestPoints);
  const auto r = registered(stroked);
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_FALSE(r->accepted);
  // It fits, as it does in many places; the reason is the uncertainty at the screws.
  EXPECT_THAT(kinds_of(*r), Contains(Kind::kTre99AtScrews));
  EXPECT_GT(r->reasons.front().value, r->reasons.front().limit);
  EXPECT_EQ(r->reasons.front().value, r->tre_99_m);
  EXPECT_TRUE(r->reasons.front().motion.has_value()) << "it names the motion";
  ASSERT_TRUE(r->weakest.has_value());
  ASSERT_TRUE(r->stroke_next.has_value());
  // The advice names the missing part: a hundred points there are enough.
  for (const auto& s : full_.samples) {
    if ((s.true_tip.v - r->stroke_next_at.v).norm() < kAround_m) {
      EXPECT_LT(s.true_tip.v.y, hind_m - 0.012) << "that was stroked before";
      stroked.push_back(s.tip);
    }
  }
  const auto more = registered(stroked);
  ASSERT_TRUE(more.ok()) << more.error().message;
  EXPECT_THAT(more->reasons, IsEmpty());
  EXPECT_LT(error_m(l4(), more->world_from_vertebra, full_.world_from_vertebra), kSilent_m);
}

}  // namespace
}  // namespace orthonav::nav::registration_best_test
