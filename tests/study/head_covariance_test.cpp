// The covariance of a tool in World includes the head's own error if the device states it.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "study/modelled_tracker.h"
#include "tests/study/hovering_room.h"

namespace orthonav::engine::head_covariance_test {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

constexpr int kPairs = 300;

/// Mean over pairs of the squared error of the tag's place over its covariance, by its three
/// degrees of freedom: 1 where the covariance is honest. The tracker's covariance of a tag's
/// rotation, compared with which the head's is small, is tested elsewhere.
double normalised(const std::string& method, double lasting, bool stated) {
  auto room = hovering_room(lasting);
  auto tracker = create_modelled_tracker(method, *room, room->cameras()->calibration(),
                                         geometry_of(*room), {});
  EXPECT_TRUE(tracker.ok());
  double sum = 0.0;
  int count = 0;
  StereoFrame frame;
  for (int pair = 0; pair < kPairs; ++pair) {
    EXPECT_TRUE(room->cameras()->next(frame).ok());
    EXPECT_TRUE(frame.head_covariance.has_value());
    if (!stated) {
      frame.head_covariance.reset();
    }
    const auto states = (*tracker)->track(frame);
    const auto now = room->state();
    for (const nav::ToolState& state : states) {
      if (pair < 30 || state.world_from_marker.status != PoseStatus::kMeasured) {
        continue;
      }
      const auto truth = room->world_from_room() * now.room_from_marker[state.tool];
      const auto& seen = state.world_from_marker.value;
      const Vec3 off = seen.translation() - truth.translation();
      const Eigen::Map<const Matrix6> covariance(state.world_from_marker.covariance.data());
      const Eigen::Matrix3d of_place = covariance.topLeftCorner<3, 3>();
      const Eigen::Vector3d error(off.x, off.y, off.z);
      sum += error.dot(of_place.ldlt().solve(error)) / 3.0;
      ++count;
    }
  }
  EXPECT_GT(count, kPairs / 2);
  return sum / count;
}

TEST(HeadCovariance, IsPartOfAToolsInWorldWithEitherMethod) {
  for (const char* method : {"best", "paper"}) {
    const double white = normalised(method, 0.0, true);
    EXPECT_GT(white, 0.3) << method;
    EXPECT_LT(white, 1.6) << method;
    const double lasting = normalised(method, 0.5, true);
    EXPECT_GT(lasting, 0.3) << method;
    EXPECT_LT(lasting, 1.6) << method;
  }
}

TEST(HeadCovariance, IsFarTooSmallWhereTheHeadIsLeftOut) {
  EXPECT_GT(normalised("best", 0.5, false), 5.0);
}

}  // namespace
}  // namespace orthonav::engine::head_covariance_test
