#include "nav/geometry/distance_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "nav/registration/vertebra_model.h"
#include "tests/support/mesh_builder.h"
#include "tests/support/slab_bone.h"

namespace orthonav::nav {
namespace {

using test::crooked_back;
using test::slab_bone;

constexpr double kCell_m = 0.002;
constexpr double kMargin_m = 0.014;
Vec3 anywhere_in(const Bounds& box, Random& random) {
  return {random.uniform(box.low.x, box.high.x), random.uniform(box.low.y, box.high.y),
          random.uniform(box.low.z, box.high.z)};
}

double signed_distance_m(const SurfaceIndex& near, const SurfaceIndex& bone, Vec3 p) {
  const double distance = near.nearest(p)->distance_m;
  return bone.contains(p) ? -distance : distance;
}

struct FieldErrors {
  double worst_m = 0.0;
  double median_m = 0.0;
};

FieldErrors errors(const DistanceField& field, const SurfaceIndex& surface, int count) {
  Random random(11);
  std::vector<double> all;
  for (int i = 0; i < count; ++i) {
    const Vec3 p = anywhere_in(field.bounds(), random);
    const double right_m = signed_distance_m(surface, surface, p);
    DistanceField::Value value;
    if (!field.at(p, value)) {
      continue;
    }
    all.push_back(std::abs(value.distance_m - right_m));
  }
  std::sort(all.begin(), all.end());
  return {all.back(), all[all.size() / 2]};
}

struct Surface {
  explicit Surface(TriangleMesh m) : mesh(std::move(m)), index(mesh) {}
  TriangleMesh mesh;
  SurfaceIndex index;
};

DistanceField field_of(const Surface& s, double cell_m = kCell_m) {
  return {s.mesh, s.index, s.index, cell_m, kMargin_m};
}

TEST(DistanceField, IsWithinHalfACellOfTheExactDistanceEverywhereAndMostlyWithinATwentieth) {
  // Trilinear interpolation of a distance is exact off a plane; on a ball of radius r it errs by up
  // to 3 cell^2 / (8 r) a direction across, at crests and in corners by parts of a cell.
  for (const Surface& s : {Surface(slab_bone(crooked_back)), Surface(test::sphere({}, 0.02, 40)),
                           Surface(test::box({-0.02, -0.02, -0.02}, {0.02, 0.03, 0.02}))}) {
    const FieldErrors e = errors(field_of(s), s.index, 8000);
    EXPECT_LT(e.worst_m, 0.5 * kCell_m);
    EXPECT_LT(e.median_m, 0.05 * kCell_m);
    EXPECT_GT(e.worst_m, 1e-6) << "not the exact distance: nothing would be measured here";
  }
}

TEST(DistanceField, ErrsLessWithSmallerCells) {
  // A fourth on smooth surfaces: the error is one of second order.
  const Surface ball(test::sphere({}, 0.02, 40));
  const FieldErrors coarse = errors(field_of(ball, 0.004), ball.index, 5000);
  const FieldErrors fine = errors(field_of(ball, 0.002), ball.index, 5000);
  EXPECT_LT(fine.median_m, 0.4 * coarse.median_m);
}

TEST(DistanceField, IsNegativeInsideHoweverDeep) {
  const Surface s(test::box({-0.02, -0.03, -0.02}, {0.02, 0.03, 0.02}));
  const DistanceField field = field_of(s);
  Random random(5);
  int inside = 0;
  int deep = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 p = anywhere_in(field.bounds(), random);
    // By the box's faces, not by the index that the field is made with.
    const double x_m = 0.02 - std::abs(p.x), y_m = 0.03 - std::abs(p.y), z_m = 0.02 - std::abs(p.z);
    const double depth_m = std::min({x_m, y_m, z_m});
    DistanceField::Value value;
    // Nearer to the surface than the error, either sign is right.
    if (std::abs(depth_m) < 0.5 * kCell_m || !field.at(p, value)) {
      continue;
    }
    EXPECT_EQ(value.distance_m<0.0, depth_m> 0.0);
    if (depth_m > 0.0) {
      EXPECT_NEAR(value.distance_m, -depth_m, 0.5 * kCell_m);
      ++inside;
      deep += depth_m > 0.010 ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(deep, 100);
}

TEST(DistanceField, PointsAwayFromTheSurfaceAndIsItsOwnDerivative) {
  const Surface ball(test::sphere({}, 0.02, 40));
  const DistanceField field = field_of(ball);
  Random random(6);
  constexpr double kStep_m = 1e-7;
  double worst = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = anywhere_in(field.bounds(), random);
    DistanceField::Value here;
    // Towards the centre the surface is equally near on all sides.
    if (p.norm() < 0.012 || !field.at(p, here)) {
      continue;
    }
    worst = std::max(worst, (here.gradient - p / p.norm()).norm());
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 beside = p;
      beside[axis] += kStep_m;
      DistanceField::Value there;
      ASSERT_TRUE(field.at(beside, there));
      // A step across a cell's border may see two slopes; they differ by less than that.
      EXPECT_NEAR((there.distance_m - here.distance_m) / kStep_m, here.gradient[axis], 0.15);
    }
  }
  // A cell of 2 mm on a ball of 12 mm (the innermost place) turns by a sixth; half of that to
  // either side, and a facet's corner.
  EXPECT_LT(worst, 0.15);
}

TEST(DistanceField, IsNothingOutsideAndForWhatIsNoNumber) {
  const Surface s(slab_bone(crooked_back));
  const DistanceField field = field_of(s);
  const auto [low, high] = field.bounds();
  DistanceField::Value value;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 p = field.bounds().centre();
    p[axis] = low[axis];
    EXPECT_TRUE(field.at(p, value));
    p[axis] = low[axis] - 1e-9;
    EXPECT_FALSE(field.at(p, value));
    p[axis] = high[axis] - 1e-9;
    EXPECT_TRUE(field.at(p, value));
    p[axis] = high[axis] + 1e-9;
    EXPECT_FALSE(field.at(p, value));
    for (const double strange : {std::nan(""), std::numeric_limits<double>::infinity(),
                                 -std::numeric_limits<double>::infinity(), 1e300, -1e300}) {
      p[axis] = strange;
      EXPECT_FALSE(field.at(p, value)) << strange;
    }
  }
  const Bounds box = bounds_of(s.mesh);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.low[axis] - low[axis], kMargin_m, 1e-12);
    EXPECT_GE(high[axis] - box.high[axis], kMargin_m - 1e-12);
  }
}

/// As for a vertebra: distances to the reachable part, signs by the whole bone.
TEST(DistanceField, TakesTheDistanceToOneSurfaceAndTheSignByAnother) {
  const Surface bone(slab_bone(crooked_back));
  const Surface back(part_of(bone.mesh, faces_reachable_from_behind(bone.mesh, bone.index)));
  ASSERT_LT(back.mesh.triangles.size(), bone.mesh.triangles.size());
  const DistanceField field(back.mesh, back.index, bone.index, kCell_m, kMargin_m);
  const Vec3 low = field.bounds().low;
  int negative = 0;
  int far = 0;
  for (int x = 0; x < 40; ++x) {
    for (int y = 0; y < 20; ++y) {
      const Vec3 node = low + kCell_m * Vec3{x + 1.0, y + 1.0, 20.0};
      DistanceField::Value value;
      if (!field.at(node + 1e-9 * Vec3{1, 1, 1}, value)) {
        continue;
      }
      const double right_m = signed_distance_m(back.index, bone.index, node);
      // Floats, and the nudge into the cell; farther off, the closest point of a neighbour.
      const bool exact = std::abs(right_m) < 2.0 * kCell_m;
      EXPECT_NEAR(value.distance_m, right_m, exact ? 2e-7 : 0.1 * kCell_m);
      far += exact ? 0 : 1;
      negative += right_m < 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(negative, 50);
  EXPECT_GT(far, 50);
}

}  // namespace
}  // namespace orthonav::nav
