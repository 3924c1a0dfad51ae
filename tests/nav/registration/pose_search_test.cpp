#include "nav/registration/search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/phantom/phantom.h"
#include "nav/registration/registration.h"
#include "tests/support/anatomy.h"
#include "tests/support/digitized_strokes.h"
#include "tests/support/slab_bone.h"

namespace orthonav::nav {
namespace {

using orthonav::test::digitize_strokes;
using orthonav::test::StrokeVariant;

/// What the posterior starts from with certainty: the field errs by tenths of a millimetre.
constexpr double kFound_m = 0.002;
constexpr double kFound_rad = 0.06;
constexpr double kNoise_m = 0.0004;
constexpr std::size_t kMost = 8;

std::vector<FoundPose> searched(const VertebraModel& model, std::span<const Point<World>> points,
                                double tip_radius_m = 0.0, std::size_t most = kMost) {
  return search_poses(model.search_field(), points, tip_radius_m, most);
}

bool is_found(const FoundPose& pose, const Transform<World, Vertebra>& truth, Point<Vertebra> at) {
  return (pose.world_from_vertebra * at - truth * at).norm() < kFound_m &&
         rotation_angle_rad(pose.world_from_vertebra.rotation(), truth.rotation()) < kFound_rad;
}

Transform<World, Vertebra> anywhere(Random& random) {
  return {test::random_rotation(random),
          {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)}};
}

std::vector<Point<World>> in_world(const std::vector<Vec3>& in_vertebra,
                                   const Transform<World, Vertebra>& pose, Random& random) {
  std::vector<Point<World>> out;
  for (const Vec3& p : in_vertebra) {
    out.push_back(pose * Point<Vertebra>{p});
    out.back().v +=
        Vec3{random.normal(0, kNoise_m), random.normal(0, kNoise_m), random.normal(0, kNoise_m)};
  }
  return out;
}

/// Sorted, none twice, no mirror image.
void expect_in_order(const std::vector<FoundPose>& found, std::size_t most = kMost) {
  EXPECT_LE(found.size(), most);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].world_from_vertebra.rotation().determinant(), 1.0, 1e-9);
    EXPECT_TRUE(std::isfinite(found[i].cost_m2));
    if (i > 0) {
      EXPECT_GE(found[i].cost_m2, found[i - 1].cost_m2);
    }
  }
}

class SlabSearch : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    model_ = VertebraModel::prepare(test::slab_bone(test::crooked_back)).value();
    places_ = test::strokes_over(model_->surface(), 10);
  }
  static void TearDownTestSuite() { model_.reset(); }
  static inline std::shared_ptr<const VertebraModel> model_;
  static inline std::vector<Vec3> places_;
};

TEST_F(SlabSearch, FindsABoxLikeBoneFirstFromAnyFrame) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Random random(seed);
    const auto truth = anywhere(random);
    const auto found = searched(*model_, in_world(places_, truth, random));
    ASSERT_FALSE(found.empty());
    expect_in_order(found);
    EXPECT_TRUE(is_found(found[0], truth, {{0, 0, 0}})) << "frame " << seed;
    ASSERT_GT(found.size(), 1U);
    EXPECT_GT(found[1].cost_m2, 1.5 * found[0].cost_m2) << "nothing else is like it";
  }
}

TEST_F(SlabSearch, FindsBothPosesOfABoneThatHasTwo) {
  const auto twofold = VertebraModel::prepare(test::slab_bone(test::twofold_back)).value();
  const auto places = test::strokes_over(twofold->surface(), 10);
  const Transform<Vertebra, Vertebra> half_turn(rotation_from_vector({0, std::acos(-1.0), 0}), {});
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Random random(seed);
    const auto truth = anywhere(random);
    const auto found = searched(*twofold, in_world(places, truth, random));
    ASSERT_GE(found.size(), 2U);
    for (const auto& pose : {truth, truth * half_turn}) {
      EXPECT_TRUE(is_found(found[0], pose, {}) || is_found(found[1], pose, {})) << seed;
    }
    EXPECT_LT(found[1].cost_m2, 1.2 * found[0].cost_m2);
  }
}

TEST_F(SlabSearch, FindsNoneWithoutPoints) {
  EXPECT_TRUE(searched(*model_, {}).empty());
  EXPECT_TRUE(searched(*model_, std::vector<Point<World>>(5)).empty());
  // All in one place: whatever comes out is finite.
  const std::vector<Point<World>> same(3000, {{1, 2, 3}});
  expect_in_order(searched(*model_, same));
}

TEST_F(SlabSearch, KeepsToWhatIsAsked) {
  Random random(1);
  const auto truth = anywhere(random);
  const auto found = searched(*model_, in_world(places_, truth, random), 0.0, 3);
  expect_in_order(found, 3);
  ASSERT_EQ(found.size(), 3U);
  const Point<Vertebra> at{{0, 0, 0}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_TRUE(rotation_angle_rad(found[i].world_from_vertebra.rotation(),
                                     found[k].world_from_vertebra.rotation()) >= kSamePose_rad ||
                  (found[i].world_from_vertebra * at - found[k].world_from_vertebra * at).norm() >=
                      kSamePose_m - 0.001);
    }
  }
}

TEST_F(SlabSearch, KnowsATipWithARadius) {
  constexpr double kRadius_m = 0.002;
  std::vector<Vec3> centres;
  for (const Vec3& p : places_) {
    centres.push_back(p + kRadius_m * model_->surface().nearest(p)->normal);
  }
  Random random(2);
  const auto truth = anywhere(random);
  const auto points = in_world(centres, truth, random);
  const auto with = searched(*model_, points, kRadius_m);
  const auto without = searched(*model_, points);
  ASSERT_FALSE(with.empty());
  ASSERT_FALSE(without.empty());
  EXPECT_TRUE(is_found(with[0], truth, {}));
  EXPECT_GT(without[0].cost_m2, 1.2 * with[0].cost_m2);
}

TEST_F(SlabSearch, RefinesAStartThatIsNear) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Random random(seed);
    const auto truth = anywhere(random);
    const Vec3 turn = random.uniform(0.02, 0.05) * (test::random_rotation(random) * Vec3{0, 0, 1});
    const Vec3 shift = 0.002 * (test::random_rotation(random) * Vec3{0, 0, 1});
    const auto start = truth * Transform<Vertebra, Vertebra>(rotation_from_vector(turn), shift);
    const std::vector starts{start};
    const auto found =
        refined_pose(model_->search_field(), in_world(places_, truth, random), starts, 0.0);
    for (const Point<Vertebra>& at : {Point<Vertebra>{{0.03, 0.0, 0.02}}, {{-0.03, 0.0, -0.02}}}) {
      EXPECT_LT((found.world_from_vertebra * at - truth * at).norm(), 0.0004) << seed;
      EXPECT_GT((start * at - truth * at).norm(), 0.0004) << "the control";
    }
    EXPECT_LT(found.cost_m2, 1e-6);
  }
  // Far from the bone nothing moves it.
  const std::vector<Point<World>> far(50, {{1, 1, 1}});
  const std::vector<Transform<World, Vertebra>> starts(1);
  const auto found = refined_pose(model_->search_field(), far, starts, 0.0);
  EXPECT_EQ((found.world_from_vertebra * Point<Vertebra>{}).v.norm(), 0.0);
  EXPECT_NEAR(found.cost_m2, 9e-6, 1e-12) << "every point counts as 3 mm off";
}

TEST(PhantomSearch, FindsThePoseAmongItsResultsHoweverItWasStroked) {
  const auto mesh = engine::phantom({"L4"}).levels.at(0).mesh;
  const auto model = VertebraModel::prepare(mesh).value();
  std::uint64_t seed = 0;
  for (const StrokeVariant variant : orthonav::test::kStrokeVariants) {
    for (int i = 0; i < 2; ++i, ++seed) {
      const auto strokes = digitize_strokes(mesh, variant, seed).value();
      const auto found = searched(*model, strokes.tips());
      expect_in_order(found);
      const Point<Vertebra> back{model->reachable_axes().centre_m};
      const auto rank = std::find_if(found.begin(), found.end(),
                                     [&](const FoundPose& pose) {
                                       return is_found(pose, strokes.world_from_vertebra, back);
                                     }) -
                        found.begin();
      // Of full strokes it is the best; of a part of them it may be one of several.
      const bool whole = variant != StrokeVariant::kPartial && variant != StrokeVariant::kSparse;
      EXPECT_LT(rank, whole ? 1 : static_cast<std::ptrdiff_t>(found.size()))
          << name_of(variant) << " seed " << seed;
    }
  }
}

}  // namespace
}  // namespace orthonav::nav
