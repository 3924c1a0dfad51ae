// The recorded sample: our method held against AprilTag, triangulation and Horn done by hand, with
// nothing of nav in it, and against the truth.
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Dense>
#include <map>

#include "nav/published/corner_tracker.h"
#include "nav/tracking/tool_tracker.h"
#include "tests/support/sample_recording.h"

namespace orthonav::nav {
namespace {

using Pose = Transform<World, Marker>;
const Point<Marker> kTip{{0.0, -0.15, 0.0}};

struct Errors {
  double position = 0.0;
  double rotation = 0.0;
  double tip = 0.0;
  int count = 0;

  void add(const Pose& pose, const Pose& truth) {
    position += (pose.translation() - truth.translation()).squared_norm();
    rotation += std::pow(rotation_angle_rad(pose.rotation(), truth.rotation()), 2);
    tip += (pose * kTip - truth * kTip).squared_norm();
    ++count;
  }
  [[nodiscard]] double tip_rms_m() const { return std::sqrt(tip / count); }
  [[nodiscard]] double position_rms_m() const { return std::sqrt(position / count); }
  [[nodiscard]] double rotation_rms_rad() const { return std::sqrt(rotation / count); }
};

using Corners = std::array<Vec2, 4>;

class HandMade {
 public:
  explicit HandMade(const StereoCalibration& calibration) : calibration_(calibration) {
    apriltag_detector_add_family(detector_, family_);
  }
  HandMade(const HandMade&) = delete;
  HandMade& operator=(const HandMade&) = delete;
  ~HandMade() {
    apriltag_detector_destroy(detector_);
    tag36h11_destroy(family_);
  }

  std::map<int, Pose> poses(const StereoFrame& frame) {
    const auto left = detect(frame.left);
    const auto right = detect(frame.right);
    std::map<int, Pose> found;
    for (const auto& [id, corners] : left) {
      if (right.count(id) > 0) {
        found[id] = *frame.world_from_rig * horn(triangulated(corners, right.at(id)));
      }
    }
    return found;
  }

 private:
  std::map<int, Corners> detect(const GreyImage& image) {
    std::vector<std::uint8_t> copy = image.pixels;
    image_u8_t view = {image.width_px, image.height_px, image.width_px, copy.data()};
    detector_->quad_decimate = 1.0f;
    zarray_t* seen = apriltag_detector_detect(detector_, &view);
    std::map<int, Corners> found;
    for (int i = 0; i < zarray_size(seen); ++i) {
      apriltag_detection_t* tag = nullptr;
      zarray_get(seen, i, &tag);
      for (std::size_t k = 0; k < 4; ++k) {
        found[tag->id][k] = {tag->p[k][0], tag->p[k][1]};
      }
    }
    apriltag_detections_destroy(seen);
    return found;
  }

  // The mid-point by linear least squares: minimise the distance to both rays.
  [[nodiscard]] Eigen::Matrix<double, 3, 4> triangulated(const Corners& left,
                                                         const Corners& right) const {
    Eigen::Matrix<double, 3, 4> points;
    const auto from_left = calibration_.left_from_rig.inverse();
    const auto from_right = calibration_.right_from_rig.inverse();
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec2 a = calibration_.left.unproject(left[k]).value();
      const Vec2 b = calibration_.right.unproject(right[k]).value();
      Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
      Eigen::Vector3d side = Eigen::Vector3d::Zero();
      const auto add = [&](Vec3 origin, Vec3 direction) {
        const Vec3 d = direction.normalized();
        const Eigen::Vector3d e(d.x, d.y, d.z);
        const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - e * e.transpose();
        normal += across;
        side += across * Eigen::Vector3d(origin.x, origin.y, origin.z);
      };
      add(from_left.translation(), from_left.rotation() * Vec3{a.x, a.y, 1});
      add(from_right.translation(), from_right.rotation() * Vec3{b.x, b.y, 1});
      points.col(static_cast<Eigen::Index>(k)) = normal.ldlt().solve(side);
    }
    return points;
  }

  static Transform<Rig, Marker> horn(const Eigen::Matrix<double, 3, 4>& in_rig) {
    Eigen::Matrix<double, 3, 4> in_marker;
    in_marker << -0.02, 0.02, 0.02, -0.02, -0.02, -0.02, 0.02, 0.02, 0, 0, 0, 0;
    const Eigen::Matrix4d t = Eigen::umeyama(in_marker, in_rig, false);
    Mat3 rotation;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        rotation[r][static_cast<std::size_t>(c)] = t(r, c);
      }
    }
    return {rotation, {t(0, 3), t(1, 3), t(2, 3)}};
  }

  const StereoCalibration& calibration_;
  apriltag_detector_t* detector_ = apriltag_detector_create();
  apriltag_family_t* family_ = tag36h11_create();
};

class RecordedSample : public ::testing::Test {
 protected:
  void SetUp() override {
    sample_ = test::load_sample();
    if (!sample_) {
      GTEST_SKIP() << "needs shared/recordings/streamrecorder-sample";
    }
  }

  // Errors by tag id; every visible tag must be measured and nothing else.
  std::map<int, Errors> tracked(const TrackerOptions& options) {
    auto tracker = published::create_corner_tracker(sample_->calibration, sample_->tools, options);
    EXPECT_TRUE(tracker.ok());
    std::map<int, Errors> errors;
    for (const StereoFrame& frame : sample_->frames) {
      for (const ToolState& state : (*tracker)->track(frame)) {
        const int id = sample_->tools[state.tool].marker.id;
        const test::TruthRow* truth = sample_->find(frame.time, id);
        const bool measured = state.world_from_marker.status == PoseStatus::kMeasured;
        EXPECT_EQ(measured, truth && truth->visible)
            << "tag " << id << " in pair " << frame.sequence;
        if (measured && truth) {
          errors[id].add(state.world_from_marker.value, truth->world_from_marker);
        }
      }
    }
    return errors;
  }

  std::optional<test::SampleRecording> sample_;
};

TEST_F(RecordedSample, TipIsAsGoodAsDoneByHand) {
  HandMade hand(sample_->calibration);
  std::map<int, Errors> by_hand;
  for (const StereoFrame& frame : sample_->frames) {
    for (const auto& [id, pose] : hand.poses(frame)) {
      by_hand[id].add(pose, sample_->find(frame.time, id)->world_from_marker);
    }
  }
  const std::map<int, Errors> ours = tracked({});
  ASSERT_EQ(ours.size(), 2u);
  for (const auto& [id, errors] : ours) {
    ASSERT_EQ(errors.count, by_hand[id].count);
    EXPECT_LE(errors.tip_rms_m(), 1.1 * by_hand[id].tip_rms_m()) << "tag " << id;
    RecordProperty("tip_um_" + std::to_string(id), static_cast<int>(errors.tip_rms_m() * 1e6));
    RecordProperty("tip_by_hand_um_" + std::to_string(id),
                   static_cast<int>(by_hand[id].tip_rms_m() * 1e6));
  }
}

TEST_F(RecordedSample, PosesAreNearTheTruth) {
  for (const auto& [id, errors] : tracked({})) {
    // Corners are good to 0.04 px there: 0.15 mm in depth at 0.5 m, 0.9° of tilt.
    EXPECT_LT(errors.position_rms_m(), 0.0002) << "tag " << id;
    EXPECT_LT(errors.rotation_rms_rad(), 0.016) << "tag " << id;
  }
}

TEST_F(RecordedSample, BoxSearchMissesNothing) {
  const auto whole = tracked({});
  const auto boxes = tracked({.full_search_interval = 10});
  for (const auto& [id, errors] : boxes) {
    EXPECT_EQ(errors.count, whole.at(id).count);
    EXPECT_NEAR(errors.tip_rms_m(), whole.at(id).tip_rms_m(), 1e-5);
  }
}

}  // namespace
}  // namespace orthonav::nav
