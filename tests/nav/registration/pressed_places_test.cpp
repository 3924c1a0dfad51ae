#include "nav/registration/presses.h"

#include <gmock/gmock.h>

#include <cmath>

#include "nav/registration/check_points.h"
#include "tests/nav/registration/fitted_presses.h"
#include "tests/nav/registration/stroked_bone.h"

namespace orthonav::nav {
namespace {

using ::testing::Each;
using ::testing::SizeIs;

constexpr double kRightWithin_m = 0.002;
/// The gap beneath a pressed tip, as for the simulated surgeon: SD before it is cut off at 0.
constexpr double kPress_m = 0.0003;

/// Stroked, then pressed in places; the model is exact.
class PressedBone : public StrokedBone {
 public:
  PressedBone(std::uint64_t seed, double tissue_m) : StrokedBone(exact_model(), seed, tissue_m) {}
  /// On the bone where it truly is, beneath a point of a stroke.
  PressedPlace pressed_below(Point<World> stroked) {
    const Vec3 p = (strokes_.world_from_vertebra.inverse() * stroked).v;
    const auto nearest = model().reachable_surface().nearest(p).value();
    const Vec3 tip = nearest.point_m + std::abs(random_.normal(0.0, kPress_m)) * nearest.normal;
    return {strokes_.world_from_vertebra * Point<Vertebra>{tip}, 0.0001};
  }
  /// Places one after the other, each where it adds most information.
  std::vector<PressedPlace> press(std::size_t count) {
    std::vector<PressedPlace> places;
    while (places.size() < count) {
      const auto next = next_place(model(), registration, points, places, options);
      if (!next) {
        break;
      }
      places.push_back(pressed_below(next->place));
    }
    return places;
  }

 private:
  static const std::shared_ptr<const VertebraModel>& exact_model() {
    static const auto kModel = VertebraModel::prepare(level().mesh).value();
    return kModel;
  }
};

TEST(PressedPlaces, TakeTheErrorOfSoftTissueAway) {
  constexpr std::uint64_t kSeeds = 12;
  int provisional = 0, accepted = 0, within_95 = 0;
  double before_m = 0.0, after_m = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    PressedBone bone(seed, 0.0025);
    provisional += bone.registration.provisional ? 1 : 0;
    const auto joined =
        fitted_and_joined(bone.model(), bone.registration, bone.press(10), bone.options).value();
    accepted += joined.registration.accepted ? 1 : 0;
    EXPECT_FALSE(joined.registration.accepted && bone.error_m(joined.registration) > kRightWithin_m)
        << "seed " << seed;
    // With places, the bone's motion since the strokes counts too, and a model's usual error where
    // the strokes told a smaller one.
    constexpr double kNoLarger = 1.05;
    EXPECT_LE(joined.registration.tre_99_m, kNoLarger * bone.registration.tre_99_m);
    within_95 += bone.error_m(joined.registration) <= joined.registration.tre_95_m ? 1 : 0;
    before_m += bone.error_m(bone.registration) / kSeeds;
    after_m += bone.error_m(joined.registration) / kSeeds;
  }
  EXPECT_GE(provisional, 4) << "else nothing is shown";
  EXPECT_GE(accepted, 10);
  EXPECT_GE(within_95, 10);
  EXPECT_LT(after_m, 0.6 * before_m);
}

TEST(PressedPlaces, OneThatSlippedStandsOut) {
  PressedBone bone(3, 0.0015);
  auto places = bone.press(8);
  ASSERT_THAT(places, SizeIs(8));
  const auto right =
      fitted_and_joined(bone.model(), bone.registration, places, bone.options).value();
  const auto up = right.registration.world_from_vertebra * Direction<Vertebra>{{0, 1, 0}};
  places[5].place = places[5].place + 0.006 * up.v;
  const auto wrong =
      fitted_and_joined(bone.model(), bone.registration, places, bone.options).value();
  std::vector<CheckPoint> points(places.size());
  for (CheckPoint& point : points) {
    point.within = true;
  }
  weigh(right.fit, points);
  EXPECT_THAT(points, Each(::testing::Field(&CheckPoint::within, true)));
  weigh(wrong.fit, points);
  EXPECT_FALSE(points[5].within);
  EXPECT_GT(points[5].distance_m, points[5].limit_m);
}

TEST(PressedPlaces, TheSamePlaceAgainTellsHardlyMore) {
  PressedBone bone(4, 0.0025);
  auto places = bone.press(4);
  ASSERT_THAT(places, SizeIs(4));
  const auto once =
      fitted_and_joined(bone.model(), bone.registration, places, bone.options).value();
  for (int copy = 0; copy < 4; ++copy) {
    places.insert(places.end(), places.begin(), places.begin() + 4);
  }
  const auto often =
      fitted_and_joined(bone.model(), bone.registration, places, bone.options).value();
  EXPECT_GT(often.registration.predicted_tre_m, 0.9 * once.registration.predicted_tre_m);
}

TEST(PressedPlaces, AModelTakenAsExactStillCountsInTheUncertainty) {
  PressedBone bone(6, 0.0025);
  const auto places = bone.press(3);
  ASSERT_THAT(places, SizeIs(3));
  PressModel press;
  press.model_in_limits = false;
  const auto told =
      fitted_and_joined(bone.model(), bone.registration, places, bone.options, press).value();
  const Point<Vertebra> middle{bone.model().reachable_axes().centre_m};
  const auto rms_m = [&](const std::array<double, 36>& covariance) {
    return PoseUncertainty(told.fit.centre_m, covariance).predicted_tre_m(middle);
  };
  const double exact_m = rms_m(told.fit.in_limits);
  EXPECT_GT(rms_m(told.fit.covariance), exact_m);
  EXPECT_LT(rms_m(told.fit.covariance), std::hypot(exact_m, std::sqrt(3.0) * kUsualModelError_m));
  EXPECT_EQ(told.registration.predicted_tre_m,
            worst_tre_m({told.fit.centre_m, told.fit.in_limits}, bone.options.targets))
      << "the limits";
  EXPECT_GT(told.registration.uncertainty->predicted_tre_m(middle), exact_m);
}

TEST(PressedPlaces, AreOfNoUseWhereTheStrokesLeaveAMotionOpen) {
  PressedBone bone(1, 0.0);
  EXPECT_TRUE(bone.registration.accepted);
  Registration alone = bone.registration;
  alone.runner_up = alone.world_from_vertebra;
  const auto joined = fitted_and_joined(bone.model(), alone, bone.press(3), bone.options).value();
  EXPECT_EQ(joined.registration.runner_up, joined.registration.world_from_vertebra)
      << "without a rival there is none afterwards";
  Registration open = bone.registration;
  open.uncertainty.reset();
  const auto places = bone.press(3);
  EXPECT_FALSE(fitted_and_joined(bone.model(), open, places, bone.options));
  EXPECT_FALSE(next_place(bone.model(), open, {}, {}, bone.options));
  const PressedPlace nowhere{{{std::nan(""), 0, 0}}, 0.0};
  EXPECT_FALSE(fitted_and_joined(bone.model(), bone.registration, {&nowhere, 1}, bone.options));
}

/// Objections that pressed places cannot settle remain.
TEST(PressedPlaces, TakeNoOtherReasonAway) {
  PressedBone bone(2, 0.0);
  Registration refused = bone.registration;
  refused.accepted = false;
  refused.reasons = {{RefusalReason::Kind::kMirrored, 9.0, 2.5}};
  const auto joined = fitted_and_joined(bone.model(), refused, bone.press(6), bone.options).value();
  EXPECT_FALSE(joined.registration.accepted);
  EXPECT_FALSE(joined.registration.provisional);
  EXPECT_THAT(joined.registration.reasons, SizeIs(1));
}

}  // namespace
}  // namespace orthonav::nav
