#include "nav/registration/check_points.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/slab_bone.h"

namespace orthonav::nav {
namespace {

class UnstrokedSurface : public ::testing::Test {
 protected:
  UnstrokedSurface() : model(*VertebraModel::prepare(test::slab_bone(test::crooked_back))) {}

  /// Strokes over the part of the back that lies left of the middle, where the bone is in the
  /// world.
  [[nodiscard]] std::vector<Point<World>> half_stroked() const {
    std::vector<Point<World>> points;
    for (const Vec3 at : test::strokes_over(model->reachable_surface(), 20)) {
      if (at.x > 0.0) {
        points.push_back(world_from_vertebra * Point<Vertebra>{at});
      }
    }
    return points;
  }

  std::shared_ptr<const VertebraModel> model;
  Transform<World, Vertebra> world_from_vertebra{rotation_from_vector({0.3, -0.2, 0.5}),
                                                 {0.1, 1.2, -0.4}};
};

TEST_F(UnstrokedSurface, IsWhatAPointerReachesAndNoStrokeCameNear) {
  const std::vector<Point<World>> points = half_stroked();
  const std::vector<float> unstroked = unstroked_surface(*model, world_from_vertebra, points);
  const std::vector<Vec3>& vertices = model->mesh().vertices_m;
  ASSERT_EQ(unstroked.size(), vertices.size());
  std::vector<char> reached(vertices.size());
  for (const std::uint32_t face : model->reachable_faces()) {
    for (const std::uint32_t v : model->mesh().triangles[face]) {
      reached[v] = 1;
    }
  }
  std::size_t far = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    double least_m = 1.0;
    for (const Point<World>& p : points) {
      least_m = std::min(least_m, ((world_from_vertebra.inverse() * p).v - vertices[i]).norm());
    }
    constexpr double kThinning_m = 0.0009;  // half a millimetre's diagonal
    if (!reached[i] || least_m < 0.004 - kThinning_m) {
      EXPECT_EQ(unstroked[i], 0.0f) << i;
    } else if (least_m > 0.006) {
      EXPECT_EQ(unstroked[i], 1.0f) << i;
      ++far;
    }
  }
  EXPECT_GT(far, 50u);
}

TEST_F(UnstrokedSurface, IsAllThatCanBeReachedWithoutStrokes) {
  const std::vector<float> unstroked = unstroked_surface(*model, world_from_vertebra, {});
  for (const std::uint32_t face : model->reachable_faces()) {
    for (const std::uint32_t v : model->mesh().triangles[face]) {
      EXPECT_EQ(unstroked[v], 1.0f);
    }
  }
  EXPECT_EQ(std::count(unstroked.begin(), unstroked.end(), 0.0f) > 0, true)
      << "the front can't be reached";
}

}  // namespace
}  // namespace orthonav::nav
