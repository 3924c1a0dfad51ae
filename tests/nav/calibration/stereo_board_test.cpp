#include "nav/calibration/stereo_board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <optional>
#include <tuple>
#include <vector>

#include "base/random.h"
#include "tests/nav/calibration/board_cameras.h"

namespace orthonav::nav::stereo_board_test {
namespace {

using ::testing::HasSubstr;

constexpr double kNoisePx = 0.1;

bool inside(Vec2 p) { return p.x > 2 && p.y > 2 && p.x < 638 && p.y < 478; }

/// The corners of a board in this pose in both cameras; nothing if a corner is outside.
std::optional<BoardView> view_of(const Chessboard& board, const Cameras& cameras,
                                 const Transform<LeftCamera, Board>& left_from_board,
                                 double noise_px, Random& random) {
  BoardView view;
  for (std::size_t i = 0; i < board.corners(); ++i) {
    const Vec2 place = board.corner_m(i);
    const Point<LeftCamera> in_left = left_from_board * Point<Board>{{place.x, place.y, 0}};
    const Vec2 left = seen(cameras.left, in_left.v);
    const Vec2 right = seen(cameras.right, (cameras.right_from_left * in_left).v);
    if (!inside(left) || !inside(right)) {
      return std::nullopt;
    }
    view.left_px.push_back(left + Vec2{random.normal(0, noise_px), random.normal(0, noise_px)});
    view.right_px.push_back(right + Vec2{random.normal(0, noise_px), random.normal(0, noise_px)});
  }
  return view;
}

/// Boards all over both images, tilted every way.
std::vector<BoardView> views(int count, Random& random, double noise_px = kNoisePx,
                             const Chessboard& board = kBoard, const Cameras& cameras = {}) {
  std::vector<BoardView> all;
  while (static_cast<int>(all.size()) < count) {
    const Mat3 rotation = rotation_from_vector(
        {random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), random.uniform(-0.4, 0.4)});
    const Vec3 middle{random.uniform(-0.25, 0.25), random.uniform(-0.2, 0.2),
                      random.uniform(0.25, 0.5)};
    const Vec3 half{0.5 * board.square_m * (board.columns - 1),
                    0.5 * board.square_m * (board.rows - 1), 0};
    if (const auto view =
            view_of(board, cameras, {rotation, middle - rotation * half}, noise_px, random)) {
      all.push_back(*view);
    }
  }
  return all;
}

double rotation_off_rad(const StereoBoardCalibration& found, const Cameras& cameras) {
  return rotation_angle_rad(found.right_from_left.rotation(), cameras.right_from_left.rotation());
}

double translation_off_m(const StereoBoardCalibration& found, const Cameras& cameras) {
  return (found.right_from_left.translation() - cameras.right_from_left.translation()).norm();
}

TEST(StereoBoard, FindsCamerasExactlyWithoutNoise) {
  Random random(1);
  const Cameras cameras;
  const auto found = calibrate_stereo(kBoard, kSize, views(12, random, 0.0));
  ASSERT_TRUE(found.ok()) << found.error().message;
  // OpenCV keeps corners as floats: 3e-5 px.
  EXPECT_LT(found->stereo_rms_px, 1e-3);
  EXPECT_FALSE(found->left.is_rational());
  EXPECT_NEAR(found->left.fx_px, 362.0, 0.01);
  EXPECT_NEAR(found->left.cx_px, 324.0, 0.01);
  EXPECT_NEAR(found->right.cy_px, 243.0, 0.01);
  EXPECT_NEAR(found->right.k1, -0.038, 1e-3);
  EXPECT_LT(rotation_off_rad(*found, cameras), 1e-4);
  EXPECT_LT(translation_off_m(*found, cameras), 1e-5);
}

TEST(StereoBoard, PredictsItsOwnErrors) {
  const Cameras cameras;
  double rotation_off = 0.0;
  double rotation_sigma = 0.0;
  double baseline = 0.0;
  double baseline_sigma = 0.0;
  constexpr int kTrials = 8;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(static_cast<std::uint64_t>(100 + trial));
    const auto found = calibrate_stereo(kBoard, kSize, views(14, random));
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_NEAR(found->stereo_rms_px, kNoisePx * std::sqrt(2.0), 0.01);
    EXPECT_NEAR(found->epipolar_rms_px, kNoisePx * std::sqrt(2.0), 0.03);
    EXPECT_EQ(found->judgement.verdict, Verdict::kPass) << found->judgement.reason;
    ASSERT_TRUE(found->sigma.has_value());
    rotation_off += std::pow(rotation_off_rad(*found, cameras), 2);
    rotation_sigma += std::pow(found->sigma->rotation_rad, 2);
    baseline += std::pow(found->baseline_m() - cameras.right_from_left.translation().norm(), 2);
    baseline_sigma += std::pow(found->sigma->baseline_m, 2);
  }
  // Eight draws of few numbers, and a jackknife that is itself rough: within a factor of two.
  EXPECT_GT(rotation_off / rotation_sigma, 0.25);
  EXPECT_LT(rotation_off / rotation_sigma, 4.0);
  EXPECT_GT(baseline / baseline_sigma, 0.25);
  EXPECT_LT(baseline / baseline_sigma, 4.0);
}

TEST(StereoBoard, LeavesOutViewsWithMistakesAndNamesThem) {
  Random random(3);
  const Cameras cameras;
  auto all = views(14, random);
  for (Vec2& corner : all[4].right_px) {
    corner = corner + Vec2{random.normal(0, 2), 1.0};
  }
  all[9].left_px[7] = all[9].left_px[7] + Vec2{14, -9};
  const auto found = calibrate_stereo(kBoard, kSize, all);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_EQ(found->used, 12u);
  for (std::size_t i = 0; i < 14; ++i) {
    EXPECT_EQ(found->views[i].used, i != 4 && i != 9) << i;
  }
  EXPECT_GT(found->views[4].right_rms_px, 1.0);
  EXPECT_LT(rotation_off_rad(*found, cameras), 0.004);
  EXPECT_EQ(found->judgement.verdict, Verdict::kNote);
  EXPECT_THAT(found->judgement.reason, HasSubstr("2 views left out"));

  StereoBoardOptions keep_all;
  keep_all.max_outlier_fraction = 0.0;
  const auto spoiled = calibrate_stereo(kBoard, kSize, all, keep_all);
  ASSERT_TRUE(spoiled.ok());
  EXPECT_GT(spoiled->stereo_rms_px, 3.0 * found->stereo_rms_px) << "the mistakes do harm";
}

TEST(StereoBoard, FailsWhereCornersAreBadEverywhere) {
  Random random(4);
  const auto found = calibrate_stereo(kBoard, kSize, views(14, random, 1.0));
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_EQ(found->judgement.verdict, Verdict::kFail);
  EXPECT_THAT(found->judgement.reason, HasSubstr("px, limit 1.00 px"));
}

constexpr ImageSize kWide{1280, 960};

/// A lens by its angle, f·θ (equidistant), 68° to the sides: neither model's own.
struct WideLens {
  double f_px = 540.0;
  Vec2 centre_px{644.0, 478.0};
  [[nodiscard]] Vec2 seen(Vec3 p) const {
    const double off = std::hypot(p.x, p.y);
    const double by = off > 0 ? f_px * std::atan2(off, p.z) / off : f_px / p.z;
    return centre_px + Vec2{p.x, p.y} * by;
  }
};

std::vector<BoardView> wide_views(int count, Random& random) {
  const WideLens left;
  const WideLens right{537.0, {636.0, 484.0}};
  std::vector<BoardView> all;
  while (static_cast<int>(all.size()) < count) {
    const Transform<LeftCamera, Board> left_from_board{
        rotation_from_vector(
            {random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), random.uniform(-0.4, 0.4)}),
        {random.uniform(-0.9, 0.6), random.uniform(-0.7, 0.4), random.uniform(0.12, 0.35)}};
    BoardView view;
    for (std::size_t i = 0; i < kBoard.corners(); ++i) {
      const Vec2 at = kBoard.corner_m(i);
      const Vec3 p = (left_from_board * Point<Board>{{at.x, at.y, 0}}).v;
      for (const auto& [lens, seen, from] :
           {std::tuple{&left, &view.left_px, p}, {&right, &view.right_px, p - Vec3{0.1, 0, 0}}}) {
        const Vec2 px = lens->seen(from) + Vec2{random.normal(0, 0.1), random.normal(0, 0.1)};
        if (from.z > 0.02 && px.x > 2 && px.y > 2 && px.x < kWide.width_px - 2 &&
            px.y < kWide.height_px - 2) {
          seen->push_back(px);
        }
      }
    }
    if (view.left_px.size() == kBoard.corners() && view.right_px.size() == kBoard.corners()) {
      all.push_back(view);
    }
  }
  return all;
}

/// What OpenCV itself leaves in the left camera.
double opencv_rms_px(const std::vector<BoardView>& views, int flags) {
  std::vector<std::vector<cv::Point2f>> seen;
  std::vector<std::vector<cv::Point3f>> board;
  for (const BoardView& view : views) {
    seen.emplace_back();
    board.emplace_back();
    for (std::size_t i = 0; i < kBoard.corners(); ++i) {
      const Vec2 at = kBoard.corner_m(i);
      board.back().emplace_back(static_cast<float>(at.x), static_cast<float>(at.y), 0.0F);
      seen.back().emplace_back(static_cast<float>(view.left_px[i].x - 0.5),
                               static_cast<float>(view.left_px[i].y - 0.5));
    }
  }
  cv::Mat matrix, distortion, rotations, translations;
  return cv::calibrateCamera(board, seen, {kWide.width_px, kWide.height_px}, matrix, distortion,
                             rotations, translations, flags,
                             {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-10});
}

TEST(StereoBoard, TakesTheRationalModelWhereThePlainOneLeavesTooMuch) {
  Random random(11);
  const std::vector<BoardView> all = wide_views(12, random);
  const auto found = calibrate_stereo(kBoard, kWide, all);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_TRUE(found->left.is_rational());
  EXPECT_GT(found->plain_rms_px, 1.0);
  EXPECT_LT(found->stereo_rms_px, 0.45);
  EXPECT_THAT(found->judgement.reason, HasSubstr("rational lens model is used (8 coefficients)"));
  EXPECT_EQ(found->judgement.verdict, Verdict::kNote) << found->judgement.reason;
  const double opencv_px = opencv_rms_px(all, cv::CALIB_RATIONAL_MODEL);
  EXPECT_NEAR(found->left_rms_px, opencv_px, 0.01);
  EXPECT_GT(opencv_rms_px(all, 0), 3.0 * opencv_px);
  EXPECT_NEAR(found->baseline_m(), 0.1, 0.0005);
  // Where the board was, the model says what the lens does.
  const auto model = CameraModel::from_brown_conrady(found->left);
  ASSERT_TRUE(model.ok());
  for (const Vec2 plane : {Vec2{0.0, 0.0}, {0.9, 0.3}, {-1.3, 0.1}, {0.2, -0.7}}) {
    const auto px = model->project(plane);
    ASSERT_TRUE(px.has_value());
    EXPECT_LT((*px - WideLens{}.seen({plane.x, plane.y, 1.0})).norm(), 0.5) << plane.x;
  }
}

TEST(StereoBoard, NotesFewAndPoorViews) {
  Random random(5);
  const auto found = calibrate_stereo(kBoard, kSize, views(4, random));
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_NE(found->judgement.verdict, Verdict::kPass);
  EXPECT_THAT(found->judgement.reason, HasSubstr("4 views, better 10"));
}

TEST(StereoBoard, TakesABoardThatLooksTheSameTurned) {
  // The corners of every other right view begin at the other end; the cameras are upright alike.
  const Chessboard even{8, 6, 0.025};
  Cameras upright;
  upright.right_from_left = {rotation_from_vector({0.01, -0.02, 0.005}), {-0.099, 0.001, 0.003}};
  Random random(6);
  auto all = views(12, random, kNoisePx, even, upright);
  for (std::size_t i = 0; i < all.size(); i += 2) {
    std::reverse(all[i].right_px.begin(), all[i].right_px.end());
  }
  const auto found = calibrate_stereo(even, kSize, all);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_LT(found->stereo_rms_px, 0.2);
  EXPECT_LT(rotation_off_rad(*found, upright), 0.005);
}

TEST(StereoBoard, RefusesWhatCannotBeCalibrated) {
  Random random(7);
  auto all = views(4, random);
  const auto refusal = [](const Chessboard& board, std::span<const BoardView> given) {
    const auto found = calibrate_stereo(board, kSize, given);
    return found ? std::string() : found.error().message;
  };
  EXPECT_THAT(refusal(kBoard, std::span(all).first(2)), HasSubstr("in 2 pairs, at least 3"));
  EXPECT_THAT(refusal(kBoard, {}), HasSubstr("in 0 pairs"));
  EXPECT_THAT(refusal({6, 6, 0.025}, all), HasSubstr("as many rows"));
  EXPECT_THAT(refusal({2, 6, 0.6}, all),
              ::testing::AllOf(HasSubstr("2 columns"), HasSubstr("600.000000 mm")));
  EXPECT_THAT(refusal({8, 6, 0.025}, all), HasSubstr("not as many corners"));
  // Four times the same view gives no information about the lens.
  const std::vector<BoardView> same(4, all[0]);
  const auto found = calibrate_stereo(kBoard, kSize, same);
  EXPECT_TRUE(!found || found->judgement.verdict != Verdict::kPass);
}

}  // namespace
}  // namespace orthonav::nav::stereo_board_test
