#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "engine/phantom/phantom.h"
#include "nav/registration/registration.h"
#include "nav/registration/shaft_collision.h"
#include "tests/support/anatomy.h"
#include "tests/support/digitized_strokes.h"
#include "tests/support/refusal_kinds.h"
#include "tests/support/slab_bone.h"
#include "tests/support/stroke_truths.h"

namespace orthonav::nav {
namespace {

using orthonav::test::digitize_strokes;
using orthonav::test::DigitizedStrokes;
using orthonav::test::StrokeVariant;
using orthonav::test::Tissue;
using test::kinds_of;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Points = std::vector<Point<World>>;

/// What a screw's place leaves room for: more is a silent failure when accepted.
constexpr double kSilent_m = 0.002;

struct Level {
  engine::CaseLevel from;
  std::shared_ptr<const VertebraModel> model;
};

/// The built-in phantom's levels, each made when it is first asked for.
class RegisterBest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    full_ = digitize_strokes(l4().from.mesh, StrokeVariant::kFull, 1).value();
  }
  static void TearDownTestSuite() { levels_.clear(); }
  static const Level& level(const std::string& label) {
    const auto known = levels_.find(label);
    if (known != levels_.end()) {
      return known->second;
    }
    Level made{engine::phantom({label}).levels.at(0), {}};
    made.model = VertebraModel::prepare(made.from.mesh).value();
    return levels_.emplace(label, std::move(made)).first->second;
  }
  static const Level& l4() { return level("L4"); }
  static PoseSearchRegistrationOptions options(const Level& of,
                                               const std::vector<std::string>& neighbours = {}) {
    PoseSearchRegistrationOptions o;
    for (const ScrewPlan& screw : of.from.screws) {
      o.targets.insert(o.targets.end(), {screw.entry, screw.target});
    }
    for (const std::string& label : neighbours) {
      o.neighbours.push_back({label, level(label).model.get()});
    }
    return o;
  }
  static Result<Registration> registered(const Points& points) {
    return register_by_pose_search(*l4().model, points, options(l4()));
  }
  static double error_m(const Level& of, const Transform<World, Vertebra>& pose,
                        const Transform<World, Vertebra>& truth) {
    double worst = 0.0;
    for (const Point<Vertebra>& p : options(of).targets) {
      worst = std::max(worst, (pose * p - truth * p).norm());
    }
    return worst;
  }
  /// Refused, whether as bad input or by a verdict, never with a mirror image.
  static void expect_refused(const Points& points, const std::string& what) {
    const auto r = registered(points);
    if (!r) {
      EXPECT_THAT(r.error().message, Not(IsEmpty())) << what;
      return;
    }
    EXPECT_FALSE(r->accepted) << what;
    EXPECT_THAT(r->reasons, Not(IsEmpty())) << what;
    EXPECT_NEAR(r->world_from_vertebra.rotation().determinant(), 1.0, 1e-9) << what;
  }
  static inline std::map<std::string, Level> levels_;
  static inline DigitizedStrokes full_;
};

TEST_F(RegisterBest, AcceptsFullStrokesAndSaysHowSureItIs) {
  const auto r = register_by_pose_search(*l4().model, full_.tips(), options(l4(), {"L3", "L5"}));
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_TRUE(r->accepted);
  EXPECT_THAT(r->reasons, IsEmpty());
  EXPECT_LT(error_m(l4(), r->world_from_vertebra, full_.world_from_vertebra), 0.0005);
  EXPECT_EQ(r->points, full_.samples.size());
  EXPECT_GT(r->log_likelihood_ratio, PoseSearchRegistrationOptions().min_log_likelihood_ratio);
  EXPECT_GT(r->inlier_fraction, 0.9);
  EXPECT_GT(r->coverage_fraction, 0.3);
  EXPECT_THAT(r->fits_better, IsEmpty());
  EXPECT_GT(r->predicted_tre_m, 0.00002);
  EXPECT_LT(r->predicted_tre_m, 0.0005);
  EXPECT_GT(r->tre_95_m, r->predicted_tre_m);
  ASSERT_TRUE(r->weakest.has_value());
  EXPECT_GT(r->weakest->error_m, 0.0);
  EXPECT_TRUE(r->stroke_next.has_value());
  EXPECT_GE(r->runner_up_rmse_m, r->rmse_m);
}

/// Tissue of uneven thickness: what is accepted is right; what is refused says why and where to
/// scrape.
TEST_F(RegisterBest, IsNeverSilentlyWrongOverSoftTissue) {
  int refused = 0;
  int scrape = 0;
  for (const Tissue tissue : orthonav::test::kTissues) {
    for (const double mean_m : {0.001, 0.002}) {
      auto strokes = digitize_strokes(l4().from.mesh, StrokeVariant::kFull, 31).value();
      apply_truths({tissue, mean_m, 0.0, 1}, l4().from.mesh, 7, strokes);
      const auto r = registered(strokes.tips());
      ASSERT_TRUE(r.ok()) << r.error().message;
      refused += r->accepted ? 0 : 1;
      if (r->accepted) {
        EXPECT_LT(error_m(l4(), r->world_from_vertebra, strokes.world_from_vertebra), kSilent_m)
            << name_of(tissue) << " " << mean_m;
      }
      for (const RefusalReason& reason : r->reasons) {
        scrape += reason.kind == RefusalReason::Kind::kSoftTissue && reason.scrape ? 1 : 0;
      }
    }
  }
  EXPECT_LE(refused, 7) << "of 10: tissue of 1 mm can be seen through";
  EXPECT_GT(scrape, 0);
}

TEST_F(RegisterBest, AStandoffOfHalfAMillimetreIsSolved) {
  auto strokes = full_;
  apply_truths({Tissue::kUniform, 0.0005, 0.0, 1}, l4().from.mesh, 7, strokes);
  const auto r = registered(strokes.tips());
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_TRUE(r->accepted);
  EXPECT_NEAR(r->standoff_m, 0.0005, 0.0001);
  EXPECT_LT(error_m(l4(), r->world_from_vertebra, strokes.world_from_vertebra), 0.0003);
}

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

TEST_F(RegisterBest, WhatShiftsAllPointsAlikeIsPartOfTheErrorToExpect) {
  auto o = options(l4());
  const auto without = register_by_pose_search(*l4().model, full_.tips(), o);
  o.common = {0.0002, 0.0002, 0.0001};
  const auto with = register_by_pose_search(*l4().model, full_.tips(), o);
  ASSERT_TRUE(without.ok() && with.ok());
  const Point<Vertebra> entry = o.targets.front();
  EXPECT_NEAR(std::pow(with->uncertainty->predicted_tre_m(entry), 2),
              std::pow(without->uncertainty->predicted_tre_m(entry), 2) + 3.0 * 0.0003 * 0.0003,
              1e-12);
  EXPECT_EQ(with->predicted_tre_m, without->predicted_tre_m) << "what the limits are about";
  EXPECT_TRUE(with->accepted);
}

TEST_F(RegisterBest, IsNeverSilentlyWrongHoweverItWasStroked) {
  std::uint64_t seed = 20;
  int accepted = 0;
  for (const StrokeVariant variant : orthonav::test::kStrokeVariants) {
    for (int i = 0; i < 2; ++i, ++seed) {
      const auto strokes = digitize_strokes(l4().from.mesh, variant, seed).value();
      const auto r = registered(strokes.tips());
      ASSERT_TRUE(r.ok()) << r.error().message;
      EXPECT_NEAR(r->world_from_vertebra.rotation().determinant(), 1.0, 1e-9);
      accepted += r->accepted ? 1 : 0;
      EXPECT_EQ(r->accepted, r->reasons.empty());
      if (r->accepted) {
        EXPECT_LT(error_m(l4(), r->world_from_vertebra, strokes.world_from_vertebra), kSilent_m)
            << name_of(variant) << " seed " << seed;
      }
    }
  }
  EXPECT_GE(accepted, 8) << "of 10: who refuses all is never wrong either";
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
  EXPECT_LT(shaft_collision_fraction(*l4().model, full_.world_from_vertebra, tips, o.shafts), 0.1);
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
  // Nothing is said of shafts that nobody knows.
  EXPECT_EQ(shaft_collision_fraction(*l4().model, full_.world_from_vertebra, tips, {}), 0.0);
  const std::vector<Vec3> unknown(tips.size());
  EXPECT_EQ(shaft_collision_fraction(*l4().model, full_.world_from_vertebra, tips, unknown), 0.0);
}

TEST_F(RegisterBest, SaysTheSameTwice) {
  const auto a = registered(full_.tips()).value();
  const auto b = registered(full_.tips()).value();
  EXPECT_EQ(a.world_from_vertebra.row_major(), b.world_from_vertebra.row_major());
  EXPECT_EQ(a.log_likelihood_ratio, b.log_likelihood_ratio);
  EXPECT_EQ(a.predicted_tre_m, b.predicted_tre_m);
  EXPECT_EQ(a.weakest, b.weakest);
  EXPECT_EQ(a.stroke_next, b.stroke_next);
}

/// The rotations that are searched lie in the frame of the points: another frame comes to the
/// optimum from another side, and the last step, of less than 10 um, leaves that much between them.
constexpr double kLastStep_m = 1e-5;

TEST_F(RegisterBest, FindsTheSamePoseInAnyFrame) {
  const auto first = registered(full_.tips()).value();
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Random random(seed);
    const Transform<World, World> other(
        test::random_rotation(random),
        {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)});
    Points points;
    for (const Point<World>& p : full_.tips()) {
      points.push_back(other * p);
    }
    const auto r = registered(points).value();
    EXPECT_TRUE(r.accepted);
    EXPECT_LT(error_m(l4(), r.world_from_vertebra, other * first.world_from_vertebra), kLastStep_m);
    EXPECT_NEAR(r.predicted_tre_m / first.predicted_tre_m, 1.0, 0.02);
  }
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
    EXPECT_THAT(kinds_of(*r), Contains(RefusalReason::Kind::kFitsOtherLevel));
    EXPECT_EQ(r->reasons.back().level, stroked);
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
}

TEST_F(RegisterBest, NeverMirrorsToFit) {
  // The phantom is nearly its own mirror image: a proper turn fits mirrored points nearly as well,
  // and no reflection is ever taken to fit them better.
  for (const int axis : {0, 1, 2}) {
    Points mirrored = full_.tips();
    for (Point<World>& p : mirrored) {
      p.v[axis] = -p.v[axis];
    }
    const auto r = registered(mirrored);
    ASSERT_TRUE(r.ok()) << r.error().message;
    EXPECT_NEAR(r->world_from_vertebra.rotation().determinant(), 1.0, 1e-9);
    EXPECT_NEAR(r->runner_up.rotation().determinant(), 1.0, 1e-9);
    EXPECT_GT(r->noise_m, 1.2 * 0.0003) << "the lean of the spinous process remains";
  }
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
  PoseSearchRegistrationOptions o = options(l4());
  o.point_sd_m.assign(tips.size(), 0.0002);
  EXPECT_TRUE(register_by_pose_search(*l4().model, tips, o).ok());
  o.point_sd_m[4] = std::nan("");
  EXPECT_THAT(register_by_pose_search(*l4().model, tips, o).error().message,
              HasSubstr("standard deviation of point 5 is"));
  o.point_sd_m.resize(7);
  EXPECT_THAT(register_by_pose_search(*l4().model, tips, o).error().message,
              HasSubstr("7 standard deviations of"));
  Points in_millimetres = tips;
  for (Point<World>& p : in_millimetres) {
    p.v = 1e3 * p.v;
  }
  EXPECT_THAT(refused(in_millimetres), HasSubstr("unit"));
}

TEST_F(RegisterBest, IsNotMisledByClumpsAndStrays) {
  // The tip rested for a minute in one place.
  Points rested = full_.tips();
  rested.insert(rested.end(), 1800, rested.back());
  // One sample in a hundred is somewhere else altogether.
  Points strays = full_.tips();
  for (std::size_t i = 0; i < strays.size(); i += 100) {
    strays[i].v += Vec3{0.1, -0.2, 0.3};
  }
  for (const Points& points : {rested, strays}) {
    const auto r = registered(points);
    ASSERT_TRUE(r.ok()) << r.error().message;
    EXPECT_LT(error_m(l4(), r->world_from_vertebra, full_.world_from_vertebra), 0.0005);
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
  // The rival is the other one: half a turn away.
  EXPECT_NEAR(
      rotation_angle_rad(twofold.runner_up.rotation(), twofold.world_from_vertebra.rotation()),
      std::acos(-1.0), 0.02);
  // The same strokes on a bone without the symmetry are taken: that alone is what was refused.
  const Registration crooked = slab_verdict(test::crooked_back, false);
  EXPECT_TRUE(crooked.accepted) << crooked.reasons.size() << " reasons";
}

TEST_F(RegisterBest, RefusesTheMirrorImageOfACrookedBone) {
  const Registration mirrored = slab_verdict(test::crooked_back, true);
  EXPECT_FALSE(mirrored.accepted) << "noise " << mirrored.noise_m << " margin "
                                  << mirrored.log_likelihood_ratio;
  EXPECT_NEAR(mirrored.world_from_vertebra.rotation().determinant(), 1.0, 1e-9);
}

TEST_F(RegisterBest, RefusesTooSmallAPartAndSaysWhatToStroke) {
  // The tip of the spinous process alone.
  Points few;
  const double hind_m = bounds_of(l4().model->mesh()).high.y;
  for (const auto& s : full_.samples) {
    if (s.true_tip.v.y > hind_m - 0.012) {
      few.push_back(s.tip);
    }
  }
  while (few.size() < 150) {
    few.insert(few.end(), few.begin(), few.end());
  }
  const auto r = registered(few);
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_FALSE(r->accepted);
  EXPECT_TRUE(r->stroke_next || r->weakest);
}

}  // namespace
}  // namespace orthonav::nav
