#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "base/angle.h"
#include "nav/registration/check_points.h"
#include "tests/nav/registration/fitted_presses.h"
#include "tests/nav/registration/stroked_bone.h"

namespace orthonav::nav::dabs_test {
namespace {

constexpr double kTissue_m = 0.0015;
/// The gap beneath a pressed tip: SD before it is cut off at 0.
constexpr double kPress_m = 0.0003;
constexpr double kTracked_m = 0.00015;
constexpr double kApart_m = 0.005;

/// The model is what a segmentation saw of a bone, which lies under tissue, is stroked, and then
/// touched in many places spread over the strokes.
class DabbedBone : public StrokedBone {
 public:
  DabbedBone(std::uint64_t seed, double model_sd_m)
      : StrokedBone(
            VertebraModel::prepare(orthonav::test::segmented(level().mesh, model_sd_m, seed))
                .value(),
            seed, kTissue_m) {}
  /// On the bone beneath a stroke, each as far from those before as can be.
  std::vector<PressedPlace> dab(std::size_t count) {
    std::vector<Vec3> chosen;
    std::vector<PressedPlace> places;
    const SurfaceIndex bone(level().mesh);
    const auto nearest_m = [&](const orthonav::test::DigitizedSample& s) {
      double least_m = s.off_bone ? 0.0 : 1.0;
      for (const Vec3 p : chosen) {
        least_m = std::min(least_m, (p - s.true_tip.v).norm());
      }
      return least_m;
    };
    while (places.size() < count) {
      const auto& s = *std::max_element(
          strokes_.samples.begin(), strokes_.samples.end(),
          [&](const auto& a, const auto& b) { return nearest_m(a) < nearest_m(b); });
      if (nearest_m(s) < kApart_m) {
        break;
      }
      chosen.push_back(s.true_tip.v);
      const Vec3 on_bone = bone.nearest(s.true_tip.v)->point_m;
      const Vec3 noise{random_.normal(0.0, kTracked_m), random_.normal(0.0, kTracked_m),
                       random_.normal(0.0, kTracked_m)};
      const Vec3 tip = on_bone + std::abs(random_.normal(0.0, kPress_m)) * s.normal + noise;
      normals.push_back(strokes_.world_from_vertebra.rotation() * s.normal);
      places.push_back({strokes_.world_from_vertebra * Point<Vertebra>{tip}, kTracked_m});
    }
    return places;
  }
  [[nodiscard]] Joined joined(std::span<const PressedPlace> places,
                              const PressModel& press = {}) const {
    return fitted_and_joined(*model_, registration, places, options, press).value();
  }
  /// The tip on the bone there.
  [[nodiscard]] PressedPlace pressed_at(Point<World> wanted) const {
    const Vec3 p = (strokes_.world_from_vertebra.inverse() * wanted).v;
    const Vec3 on_bone = SurfaceIndex(level().mesh).nearest(p)->point_m;
    return {strokes_.world_from_vertebra * Point<Vertebra>{on_bone}, kTracked_m};
  }
  /// By which the first planned axis is turned.
  [[nodiscard]] double rotation_off_deg(const Registration& r) const {
    const Vec3 axis = (options.targets[1] - options.targets[0]).normalized();
    return degrees(angle_between_rad((r.world_from_vertebra * Direction<Vertebra>{axis}).v,
                                     (strokes_.world_from_vertebra * Direction<Vertebra>{axis}).v));
  }

  std::vector<Vec3> normals;  ///< in World, of the bone beneath each dab
};

/// The mean result of two bones after this many dabs.
struct Outcome {
  double rotation_before_deg = 0.0;
  double rotation_deg = 0.0;
  double model_sd_m = 0.0;
  int beyond_99 = 0;
};

Outcome outcome(double model_sd_m, std::size_t dabs) {
  constexpr int kBones = 2;
  Outcome out;
  for (int seed = 1; seed <= kBones; ++seed) {
    DabbedBone bone(static_cast<std::uint64_t>(seed), model_sd_m);
    const auto joined = bone.joined(bone.dab(dabs));
    out.rotation_before_deg += bone.rotation_off_deg(bone.registration) / kBones;
    out.rotation_deg += bone.rotation_off_deg(joined.registration) / kBones;
    out.model_sd_m += joined.fit.model_sd_m / kBones;
    out.beyond_99 += bone.error_m(joined.registration) > joined.registration.tre_99_m ? 1 : 0;
  }
  return out;
}

TEST(Dabs, TurnTheBoneRightAndTellHowGoodTheModelIs) {
  const Outcome exact = outcome(0.0, 40);
  const Outcome usual = outcome(0.0005, 40);
  const Outcome bad = outcome(0.0008, 40);
  EXPECT_LT(exact.rotation_deg, 0.7 * exact.rotation_before_deg);
  EXPECT_LT(usual.rotation_deg, 0.8 * usual.rotation_before_deg);
  EXPECT_LT(exact.model_sd_m, 0.00030);
  EXPECT_GT(bad.model_sd_m, 0.00055);
  EXPECT_LT(exact.model_sd_m, usual.model_sd_m);
  EXPECT_LT(usual.model_sd_m, bad.model_sd_m);
  EXPECT_EQ(exact.beyond_99 + usual.beyond_99 + bad.beyond_99, 0);
}

TEST(Dabs, OneThatSlippedStandsOutAndDoesNotPassForABadModel) {
  DabbedBone bone(3, 0.0);
  auto places = bone.dab(30);
  places[11].place = places[11].place + 0.003 * bone.normals[11];
  const auto joined = bone.joined(places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool far = std::abs(joined.fit.off_m[i]) > std::max(0.001, 4.0 * joined.fit.off_sd_m[i]);
    EXPECT_EQ(far, i == 11) << i << ": " << joined.fit.off_m[i] << " ± " << joined.fit.off_sd_m[i];
  }
}

/// Whether each of this many places, which agree with each other, passes at that distance from the
/// surface.
bool all_within(std::size_t places, double distance_m) {
  PressFit fit;
  fit.off_m.assign(places, 0.0);
  fit.off_sd_m.assign(places, 0.0003);
  CheckPoint off;
  off.distance_m = distance_m;
  std::vector<CheckPoint> points(places, off);
  weigh(fit, points);
  return std::all_of(points.begin(), points.end(), [](const CheckPoint& p) { return p.within; });
}

TEST(Dabs, ManyThatAgreeMayLieTwiceTheLimitOff) {
  EXPECT_TRUE(all_within(8, 0.0039));
  EXPECT_FALSE(all_within(8, 0.0041)) << "the twin";
  EXPECT_FALSE(all_within(7, 0.0039)) << "the twin";
}

TEST(Dabs, TheSameModelDoesNotCountTwice) {
  DabbedBone bone(4, 0.0005);
  const auto places = bone.dab(20);
  auto twice = places;
  twice.insert(twice.end(), places.begin(), places.end());
  const double once_m = bone.joined(places).registration.predicted_tre_m;
  EXPECT_GT(bone.joined(twice).registration.predicted_tre_m, 0.85 * once_m);
  EXPECT_LT(bone.joined(bone.dab(40)).registration.predicted_tre_m, 0.85 * once_m) << "the twin";
}

/// The error left after the eighth proposed place, and how far that place lies from the others.
struct Eighth {
  double left = 0.0;
  double nearest_m = 1.0;
};

/// With no least distance between places, so that only what the model leaves keeps them apart.
Eighth eighth_place(const DabbedBone& bone) {
  std::vector<PressedPlace> places;
  Eighth out;
  for (int k = 0; k < 8; ++k) {
    const NextPlace next =
        next_place(bone.model(), bone.registration, bone.points, places, bone.options, {}, 0.0)
            .value();
    EXPECT_LT(next.tre_then_m, next.tre_m);
    out = {next.tre_then_m / next.tre_m, 1.0};
    for (const PressedPlace& place : places) {
      out.nearest_m = std::min(out.nearest_m, (place.place - next.place).norm());
    }
    places.push_back(bone.pressed_at(next.place));
  }
  return out;
}

TEST(Dabs, AProposalKnowsWhatTheModelLeavesOfIt) {
  const Eighth eighth = eighth_place(DabbedBone(6, 0.0008));
  EXPECT_GT(eighth.left, 1.0 - 0.15);
  EXPECT_LT(eighth.left, 1.0 - 0.01);
  EXPECT_GT(eighth.nearest_m, 0.005) << "beside another one the model is as wrong";
}

}  // namespace
}  // namespace orthonav::nav::dabs_test
