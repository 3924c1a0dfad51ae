#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "tests/support/camera_scene.h"
#include "tests/support/tag_detection.h"

// Tags must be where geometry puts them to a hundredth of a pixel, because every accuracy figure
// depends on it.
namespace orthonav::sim {
namespace {

/// Mean offset of an edge of the rendered border from the projected one.
constexpr double kEdgeBiasPx = 0.01;
/// With blur half a dozen pixels lie between levels that are known to half a grey of 170.
constexpr double kBlurredEdgeBiasPx = 0.015;
/// AprilTag's own bias on blur-free edges is a few hundredths of a pixel.
constexpr double kCornerPx = 0.25;

ErrorModel perfect_camera() {
  ErrorModel m;
  m.blur_sigma_px = 0.0;
  m.vignetting = 0.0;
  m.shot_noise = 0.0;
  m.read_noise_grey = 0.0;
  return m;
}

const StereoCalibration& shared_calibration() {
  static const StereoCalibration both = hololens2_calibration();
  return both;
}

struct TagScene {
  RoomDescription room;
  RoomState state;
  const StereoCalibration& calibration = shared_calibration();

  /// One tag of that size (id 3), posed in the left camera.
  TagScene(double size_m, const Mat3& camera_from_marker, Vec3 at_m) {
    room.tools = {scene::tool("pointer", ToolKind::kPointer, 3, size_m, 0.15)};
    state.room_from_rig = {Mat3::identity(), {0.0, 0.6, 0.0}};
    const Transform<LeftCamera, Marker> pose{camera_from_marker, at_m};
    state.room_from_marker = {state.room_from_rig * calibration.left_from_rig.inverse() * pose};
    state.tool_present = {true};
  }
  [[nodiscard]] GreyImage left(const ErrorModel& error_model, std::uint64_t seed = 1) const {
    GreyImage image;
    RoomRenderer::create(room, error_model)
        ->render(std::vector<RoomState>{state}, calibration.left, calibration.left_from_rig, seed,
                 image);
    return image;
  }
  [[nodiscard]] Vec2 projected(double x_m, double y_m) const {
    const auto camera_from_marker =
        calibration.left_from_rig * state.room_from_rig.inverse() * state.room_from_marker[0];
    return *calibration.left.project((camera_from_marker * Point<Marker>{{x_m, y_m, 0.0}}).v);
  }
};

/// A tag that faces the camera, upright in the image, then turned.
Mat3 facing(Vec3 rotation_rad) {
  const Mat3 upright = {{{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}};
  return rotation_from_vector(rotation_rad) * upright;
}

/// The mean offset, outwards, of one side of the border in the image from where it should be;
/// `offset_px` moves the expectation (for must-fail twins). Side k runs from corner k to k + 1.
double side_offset_px(const TagScene& s, const GreyImage& image, int side, double offset_px = 0.0) {
  const double h = s.room.tools[0].size_m / 2;
  const std::array<Vec2, 5> corners = {{{-h, -h}, {h, -h}, {h, h}, {-h, h}, {-h, -h}}};
  const Vec2 a = corners[static_cast<std::size_t>(side)];
  const Vec2 b = corners[static_cast<std::size_t>(side) + 1];
  std::vector<Vec2> edge;  // without the ends, where the other sides' corners are
  for (int i = 150; i <= 850; ++i) {
    edge.push_back(s.projected(a.x + (b.x - a.x) * i / 1000, a.y + (b.y - a.y) * i / 1000));
  }
  const Vec2 middle = s.projected(0, 0);
  const Vec2 run = edge.back() - edge.front();
  const bool upright = std::abs(run.y) > std::abs(run.x);
  const auto along = [&](Vec2 p) { return upright ? p.y : p.x; };
  const auto across = [&](Vec2 p) { return upright ? p.x : p.y; };
  if (along(edge.front()) > along(edge.back())) {
    std::reverse(edge.begin(), edge.end());
  }
  const double outward = across(edge[edge.size() / 2]) > across(middle) ? 1.0 : -1.0;
  double sum = 0.0;
  int count = 0;
  for (int line = static_cast<int>(along(edge.front())) + 1; line + 1 < along(edge.back());
       ++line) {
    const auto above =
        std::find_if(edge.begin(), edge.end(), [&](Vec2 p) { return along(p) >= line + 0.5; });
    const Vec2 q = *above;
    const Vec2 p = *(above - 1);
    const double expected =
        across(p) + (across(q) - across(p)) * (line + 0.5 - along(p)) / (along(q) - along(p));
    constexpr int kReach = 3;  // less than a cell, which is 7 px here
    const int centre = static_cast<int>(std::floor(expected));
    const auto grey = [&](int i) {
      return static_cast<double>(upright ? image.at(i, line) : image.at(line, i));
    };
    const int step = outward > 0 ? 1 : -1;
    const double black = grey(centre - step * (kReach + 1));
    const double white = grey(centre + step * (kReach + 1));
    double dark_px = 0.0;  // how far black reaches out from the window's inner end
    for (int i = centre - kReach; i <= centre + kReach; ++i) {
      dark_px += (white - grey(i)) / (white - black);
    }
    const double measured = outward > 0 ? centre - kReach + dark_px : centre + kReach + 1 - dark_px;
    sum += outward * (measured - expected) - offset_px;
    ++count;
  }
  return sum / count;
}

struct EdgePose {
  Vec3 rotation_rad;
  Vec3 at_m;
};

const std::vector<EdgePose> kEdgePoses = {{{0, 0, 0.10}, {0.01, 0.02, 0.42}},
                                          {{0.2, -0.15, 0.22}, {-0.13, 0.09, 0.40}},
                                          {{-0.3, 0.2, -0.17}, {0.18, -0.12, 0.40}},
                                          {{0.1, 0.3, 1.70}, {0.21, 0.14, 0.38}}};

TEST(RenderedTag, EdgesLieWhereTheyProject) {
  for (const EdgePose& pose : kEdgePoses) {
    const TagScene s(0.07, facing(pose.rotation_rad), pose.at_m);
    const GreyImage image = s.left(perfect_camera());
    for (int side = 0; side < 4; ++side) {
      EXPECT_LT(std::abs(side_offset_px(s, image, side)), kEdgeBiasPx)
          << "side " << side << " of the pose at " << pose.at_m.x;
    }
  }
}

TEST(RenderedTag, EdgesTwoHundredthsOffAreCaught) {
  const TagScene s(0.07, facing(kEdgePoses[1].rotation_rad), kEdgePoses[1].at_m);
  const GreyImage image = s.left(perfect_camera());
  for (int side = 0; side < 4; ++side) {
    EXPECT_GT(std::abs(side_offset_px(s, image, side, 0.02)), kEdgeBiasPx);
    EXPECT_GT(std::abs(side_offset_px(s, image, side, -0.02)), kEdgeBiasPx);
  }
}

TEST(RenderedTag, BlurLeavesEdgesInPlace) {
  ErrorModel blurred = perfect_camera();
  blurred.blur_sigma_px = 0.7;
  const TagScene s(0.07, facing({0.1, -0.1, 0.15}), {0.05, 0.03, 0.35});
  const GreyImage image = s.left(blurred);
  for (int side = 0; side < 4; ++side) {
    EXPECT_LT(std::abs(side_offset_px(s, image, side)), kBlurredEdgeBiasPx);
  }
}

TEST(RenderedTag, AprilTagFindsItsCornersWhereTheyAre) {
  for (const EdgePose& pose : kEdgePoses) {
    const TagScene s(0.07, facing(pose.rotation_rad), pose.at_m);
    const auto found = scene::detect(s.left(ErrorModel{}));
    ASSERT_EQ(found.size(), 1u);
    ASSERT_TRUE(found.contains(3));
    const double h = 0.035;
    const std::array<Vec2, 4> corners = {{{-h, -h}, {h, -h}, {h, h}, {-h, h}}};
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_LT((found.at(3)[k] - s.projected(corners[k].x, corners[k].y)).norm(), kCornerPx) << k;
    }
  }
}

TEST(RenderedTag, IsDetectedAtArmsLength) {
  // 30 mm at 0.7 m is 15 px across; every distance and direction a surgeon works at must be read.
  Random random(4);
  for (const double distance_m : {0.3, 0.4, 0.5, 0.6, 0.7}) {
    for (int i = 0; i < 12; ++i) {
      const Vec3 tilt{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5),
                      random.uniform(-3.1, 3.1)};
      const Vec3 at = distance_m * Vec3{random.uniform(-0.3, 0.3), random.uniform(-0.25, 0.25), 1};
      const TagScene s(0.03, facing(tilt), at);
      EXPECT_TRUE(scene::detect(s.left(ErrorModel{}, random.next())).contains(3))
          << distance_m << " m, try " << i;
    }
  }
}

TEST(RenderedTag, FacingAwayShowsAGreyBack) {
  const TagScene away(0.07, facing({3.14159, 0, 0}), {0.0, 0.0, 0.4});
  const TagScene towards(0.07, facing({0, 0, 0}), {0.0, 0.0, 0.4});
  EXPECT_TRUE(scene::detect(away.left(perfect_camera())).empty());
  EXPECT_EQ(scene::detect(towards.left(perfect_camera())).size(), 1u);
  const Vec2 centre = away.projected(0.015, 0.015);
  const GreyImage image = away.left(perfect_camera());
  const int grey = image.at(static_cast<int>(centre.x), static_cast<int>(centre.y));
  EXPECT_GT(grey, 50);
  EXPECT_LT(grey, 120);
}

TEST(RenderedTag, BehindTheCameraIsNotDrawn) {
  TagScene behind(0.07, facing({0, 0, 0}), {0.0, 0.0, -0.4});
  TagScene absent = behind;
  absent.state.tool_present = {false};
  EXPECT_EQ(behind.left(perfect_camera()), absent.left(perfect_camera()));
}

TEST(RenderedTag, APoseThatIsNotFiniteIsNotDrawn) {
  TagScene broken(0.07, facing({0, 0, 0}), {0.0, std::nan(""), 0.4});
  TagScene absent = broken;
  absent.state.tool_present = {false};
  EXPECT_EQ(broken.left(perfect_camera()), absent.left(perfect_camera()));
}

TEST(RenderedTag, IsCutAtTheImagesEdge) {
  // The tag's centre projects onto the image's left edge; half of its white rim must show.
  const Vec2 edge_ray = *shared_calibration().left.unproject({0.0, 240.0});
  const TagScene s(0.07, facing({0, 0, 0}), {0.4 * edge_ray.x, 0.4 * edge_ray.y, 0.4});
  const GreyImage image = s.left(perfect_camera());
  const Vec2 rim = s.projected(0.020, 0.035 * 1.12);  // in the quiet zone above the tag
  EXPECT_GT(image.at(static_cast<int>(rim.x), static_cast<int>(rim.y)), 150);
  const Vec2 border = s.projected(0.020, 0.035 * 0.88);
  EXPECT_LT(image.at(static_cast<int>(border.x), static_cast<int>(border.y)), 45);
  EXPECT_GT(image.at(0, static_cast<int>(rim.y)), 150);
  EXPECT_LT(image.at(0, static_cast<int>(border.y)), 45);
}

TEST(RenderedTag, MotionSmearsAlongTheMotionOnly) {
  const TagScene s(0.07, facing({0, 0, 0}), {0.0, 0.0, 0.4});
  const auto renderer = RoomRenderer::create(s.room, perfect_camera());
  // Rig axes: y is up, which is x of the left camera: the tag moves along the image's rows.
  const auto states = scene::exposure(s.state, {0.0, 0.0022, 0.0});  // 2 px a step
  GreyImage still;
  GreyImage moving;
  renderer->render(std::vector<RoomState>{s.state}, s.calibration.left, s.calibration.left_from_rig,
                   1, still);
  renderer->render(states, s.calibration.left, s.calibration.left_from_rig, 1, moving);
  const auto soft = [&](const GreyImage& image, Vec2 from, int dx, int dy) {
    int count = 0;
    for (int i = -5; i <= 5; ++i) {
      const int grey =
          image.at(static_cast<int>(from.x) + i * dx, static_cast<int>(from.y) + i * dy);
      count += grey > 38 && grey < 176 ? 1 : 0;
    }
    return count;
  };
  const Vec2 right = s.projected(0.035, 0.002);
  const Vec2 top = s.projected(0.002, 0.035);
  EXPECT_LE(soft(still, right, 1, 0), 1);
  EXPECT_GE(soft(moving, right, 1, 0), 4);
  EXPECT_LE(soft(moving, top, 0, 1), soft(still, top, 0, 1));
  for (int side = 0; side < 4; ++side) {  // and its middle is where the tag is at mid-exposure
    EXPECT_LT(std::abs(side_offset_px(s, moving, side)), 2 * kEdgeBiasPx);
  }
}

}  // namespace
}  // namespace orthonav::sim
