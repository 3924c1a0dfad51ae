#include "nav/published/registration.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "hal/sim/surgeon/stroke_plan.h"
#include "nav/published/stroke_pattern.h"
#include "nav/registration/registration.h"
#include "tests/support/registration_builder.h"

namespace orthonav::nav::published {
namespace {

/// The limit of the paper's screws; a pose in the wrong place is off by 10 mm and more.
constexpr double kRightPose_m = 0.002;

/// A flat cross of five pairs about `centre_m`: pa1 along x (reach 6), pa2 along y (reach 3 and
/// -4).
std::vector<Vec3> cross_about(Vec3 centre_m) {
  std::vector<Vec3> points;
  for (const Vec3 p : {Vec3{6, 0, 0},
                       {-6, 0, 0},
                       {5, 0, 0},
                       {-5, 0, 0},
                       {0, 3, 0},
                       {0, -4, 0},
                       {0, 2, 0},
                       {0, 0, 1},
                       {0, 0, -1},
                       {0, 0, 0}}) {
    points.push_back(centre_m + p);
  }
  return points;
}

TEST(ExtremePoints, AreThoseOfEquation1AboutTheCentroid) {
  for (const Vec3 centre : {Vec3{0, 0, 0}, Vec3{100, -50, 20}}) {
    const ExtremePoints e = extreme_points(cross_about(centre));
    EXPECT_EQ((e.e1 - e.e2).norm(), 12.0);
    EXPECT_EQ((e.e3 - centre).norm(), 4.0)
        << "the longer end of the second axis, whatever its sign";
    EXPECT_EQ(e.e3.y, centre.y - 4.0);
  }
  // The control: about the origin the place of the whole cloud would decide. Here that favours the
  // shorter end.
  const Vec3 aside{0, 50, 0};
  EXPECT_GT(std::abs((aside + Vec3{0, 3, 0}).y), std::abs((aside + Vec3{0, -4, 0}).y));
  EXPECT_EQ(extreme_points(cross_about(aside)).e3.y, 46.0);
}

TEST(CoarsePoses, AreTheTwoConfigurationsOfEquation2) {
  const ExtremePoints model{{0.04, 0, 0}, {-0.035, 0.002, 0}, {0, 0.03, -0.01}};
  const Transform<World, Vertebra> truth(rotation_from_vector({0.3, -1.2, 0.7}), {0.1, 0.2, -0.4});
  const auto seen = [&truth](Vec3 p) { return (truth * Point<Vertebra>{p}).v; };
  const auto off_m = [&truth](const Transform<World, Vertebra>& pose) {
    return (pose.translation() - truth.translation()).norm() +
           0.1 * rotation_angle_rad(pose.rotation(), truth.rotation());
  };
  const auto named = coarse_poses(model, {seen(model.e1), seen(model.e2), seen(model.e3)});
  const auto exchanged = coarse_poses(model, {seen(model.e2), seen(model.e1), seen(model.e3)});
  ASSERT_TRUE(named.ok() && exchanged.ok());
  EXPECT_LT(off_m((*named)[0]), 1e-9);
  EXPECT_GT(off_m((*named)[1]), 0.1);
  EXPECT_GT(off_m((*exchanged)[0]), 0.1);
  EXPECT_LT(off_m((*exchanged)[1]), 1e-9);
}

TEST(CoarsePoses, NeedThreePointsThatAreNotOnALine) {
  const ExtremePoints model{{0.04, 0, 0}, {-0.035, 0.002, 0}, {0, 0.03, -0.01}};
  EXPECT_FALSE(coarse_poses(model, {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).ok());
  EXPECT_FALSE(coarse_poses({{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, model).ok());
}

/// A bone, and strokes in the trained pattern over it.
class TrainedStrokes : public ::testing::Test {
 protected:
  void SetUp() override {
    level_ = test::anatomy_level("visible-human/L4");
    if (!level_) {
      GTEST_SKIP() << "needs shared/anatomy";
    }
    model_ = VertebraModel::prepare(level_->mesh).value();
  }
  /// 1 mm apart, with a noise of `sd_m` along each axis.
  test::Digitization stroked(std::uint64_t seed, double sd_m,
                             sim::Exposure exposure = sim::Exposure::kTrainedPattern) const {
    Random random(seed);
    test::Digitization d;
    d.truth = {test::random_rotation(random), {random.uniform(-1, 1), 0.3, -0.5}};
    const sim::RoomLevel bone{"L4", level_->mesh.vertices_m, level_->mesh.triangles, {}};
    for (const sim::StrokeRegion& region : sim::plan_strokes(bone, exposure)) {
      for (const sim::Stroke& stroke : region.strokes) {
        for (double along_m = 0.0; along_m <= stroke.length_m(); along_m += 0.001) {
          const Vec3 noise{random.normal(0, sd_m), random.normal(0, sd_m), random.normal(0, sd_m)};
          d.points.push_back(d.truth * Point<Vertebra>{stroke.at(along_m).point + noise});
        }
      }
    }
    return d;
  }
  Result<std::array<IcpResult, 2>> registered(const test::Digitization& d) const {
    return register_points(model_->reachable(), model_->reachable_surface(), d.points);
  }
  std::optional<test::AnatomyLevel> level_;
  std::shared_ptr<const VertebraModel> model_;
};

TEST_F(TrainedStrokes, AreRegisteredInAnyFrame) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto d = stroked(seed, 0.0005);
    const auto r = registered(d);
    ASSERT_TRUE(r.ok()) << r.error().message;
    EXPECT_LT(test::worst_screw_error_m(*level_, (*r)[0].world_from_vertebra, d.truth),
              kRightPose_m);
    EXPECT_LE((*r)[0].rmse_m, (*r)[1].rmse_m) << "the smaller RMSE is shown";
  }
}

TEST_F(TrainedStrokes, GiveTheSameBitsEveryTime) {
  const auto d = stroked(4, 0.0005);
  const auto a = registered(d);
  const auto b = registered(d);
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_EQ((*a)[0].world_from_vertebra, (*b)[0].world_from_vertebra);
  EXPECT_EQ((*a)[1].rmse_m, (*b)[1].rmse_m);
}

TEST_F(TrainedStrokes, OfTheLaminaeAloneEndElsewhereAndAreNotRefused) {
  // Why the pattern is trained: the extremes of other strokes are not those of the model.
  const auto d = stroked(5, 0.0005, sim::Exposure::kLaminae);
  const auto r = registered(d);
  ASSERT_TRUE(r.ok());
  EXPECT_GT(test::worst_screw_error_m(*level_, (*r)[0].world_from_vertebra, d.truth), kRightPose_m);
}

TEST_F(TrainedStrokes, AreWhatThePictureShows) {
  const auto lines = stroke_pattern(model_->reachable(), model_->reachable_surface());
  const ExtremePoints e = extreme_points(model_->reachable().vertices_m);
  // The picture is coarse: it shows which process, not which millimetre.
  constexpr double kReached_m = 0.008;
  for (const Vec3 place : {e.e1, e.e2, e.e3}) {
    double nearest_m = 1.0;
    for (const auto& line : lines) {
      for (const Vec3 on : line) {
        nearest_m = std::min(nearest_m, (on - place).norm());
        EXPECT_LT(std::abs(model_->surface().nearest(on)->distance_m), 1e-6) << "on the bone";
      }
    }
    EXPECT_LT(nearest_m, kReached_m);
  }
}

TEST_F(TrainedStrokes, IcpEndsWhereItBeganWhenItBeganRight) {
  const auto d = stroked(6, 0.0);
  const auto r = refine_icp(model_->surface(), d.points, d.truth);
  ASSERT_TRUE(r.ok());
  EXPECT_LT(test::worst_screw_error_m(*level_, r->world_from_vertebra, d.truth), 1e-4);
}

TEST_F(TrainedStrokes, IcpNeverRaisesTheRmse) {
  const auto d = stroked(7, 0.0005);
  const Transform<World, Vertebra> start =
      d.truth * Transform<Vertebra, Vertebra>(rotation_from_vector({0.2, -0.1, 0.15}),
                                              {0.004, -0.003, 0.006});
  double before_m = std::numeric_limits<double>::infinity();
  for (int iterations = 0; iterations <= 40; iterations += 4) {
    const auto r = refine_icp(model_->reachable_surface(), d.points, start, {iterations, 0.0});
    ASSERT_TRUE(r.ok());
    EXPECT_LE(r->rmse_m, before_m + 1e-15);
    before_m = r->rmse_m;
  }
}

}  // namespace
}  // namespace orthonav::nav::published
