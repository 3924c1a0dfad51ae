#include "hal/api/camera_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace orthonav {
namespace {

using ::testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// The contract of CameraModel::project.
constexpr double kInversePx = 1e-6;
/// Bilinear interpolation between exact pixel centres: curvature of the distortion times 1/8 px².
constexpr double kInterpolationPx = 5e-4;
const std::string kShared = ORTHONAV_SHARED_DIR;

BrownConrady wide_angle() {
  return {640, 480, 360.0, 361.0, 310.0, 245.0, -0.04, 0.012, 0.0004, -0.0003, 0.0};
}

CameraModel wide_angle_model() { return CameraModel::from_brown_conrady(wide_angle()).value(); }

/// A pinhole's table of a small image.
std::vector<Vec2> pinhole_table(int width, int height, double focal) {
  std::vector<Vec2> table;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      table.push_back({(u + 0.5 - width / 2.0) / focal, (v + 0.5 - height / 2.0) / focal});
    }
  }
  return table;
}

std::string refusal(int width, int height, std::vector<Vec2> table) {
  const auto model = CameraModel::from_lookup(width, height, std::move(table));
  return model.ok() ? "accepted" : model.error().message;
}

double worst_round_trip_px(const CameraModel& model) {
  double worst = 0.0;
  for (double v = 0.0; v <= model.height_px(); v += 7.3) {
    for (double u = 0.0; u <= model.width_px(); u += 6.1) {
      const auto ray = model.unproject({u, v});
      if (!ray) {
        continue;
      }
      const auto back = model.project(*ray);
      if (!back) {
        return 1e9;
      }
      worst = std::max(worst, (*back - Vec2{u, v}).norm());
    }
  }
  return worst;
}

TEST(CameraModel, PixelCentresGiveTheTableItself) {
  const CameraModel model = wide_angle_model();
  for (const int v : {0, 239, 479}) {
    for (const int u : {0, 320, 639}) {
      EXPECT_EQ(*model.unproject({u + 0.5, v + 0.5}),
                model.lookup()[static_cast<std::size_t>(v * 640 + u)]);
    }
  }
}

TEST(CameraModel, ProjectInvertsUnproject) {
  EXPECT_LT(worst_round_trip_px(wide_angle_model()), kInversePx);
}

TEST(CameraModel, ProjectFollowsTheDistortionFormula) {
  const BrownConrady parameters = wide_angle();
  const CameraModel model = wide_angle_model();
  double worst = 0.0;
  for (double y = -0.6; y <= 0.6; y += 0.037) {
    for (double x = -0.8; x <= 0.8; x += 0.041) {
      const auto pixel = model.project(Vec2{x, y});
      ASSERT_TRUE(pixel) << x << " " << y;
      worst = std::max(worst, (*pixel - parameters.distort({x, y})).norm());
    }
  }
  EXPECT_LT(worst, kInterpolationPx);
}

TEST(CameraModel, WrongDistortionIsCaught) {
  BrownConrady other = wide_angle();
  other.k1 -= 0.0001;
  const Vec2 corner{0.8, 0.6};
  EXPECT_GT((*wide_angle_model().project(corner) - other.distort(corner)).norm(),
            10 * kInterpolationPx);
}

TEST(CameraModel, JacobianIsTheDerivativeOfProject) {
  const CameraModel model = wide_angle_model();
  const Vec2 pixel{501.25, 77.75};
  const Vec2 ray = *model.unproject(pixel);
  const auto j = model.jacobian_px(pixel);
  ASSERT_TRUE(j);
  constexpr double kStep = 1e-5;  // 0.004 px: stays inside one cell of the table
  const Vec2 by_x = (*model.project(Vec2{ray.x + kStep, ray.y}) - pixel) * (1.0 / kStep);
  const Vec2 by_y = (*model.project(Vec2{ray.x, ray.y + kStep}) - pixel) * (1.0 / kStep);
  EXPECT_NEAR((*j)[0], by_x.x, 0.01);
  EXPECT_NEAR((*j)[1], by_y.x, 0.01);
  EXPECT_NEAR((*j)[2], by_x.y, 0.01);
  EXPECT_NEAR((*j)[3], by_y.y, 0.01);
}

TEST(CameraModel, NothingOutsideTheImage) {
  const CameraModel model = wide_angle_model();
  EXPECT_TRUE(model.unproject({0.0, 0.0}));
  EXPECT_TRUE(model.unproject({640.0, 480.0}));
  EXPECT_FALSE(model.unproject({-0.01, 100.0}));
  EXPECT_FALSE(model.unproject({100.0, 480.01}));
  EXPECT_FALSE(model.unproject({kNaN, 1.0}));
  EXPECT_FALSE(model.project(Vec2{1.2, 0.0}));
  EXPECT_FALSE(model.project(Vec2{1e200, -1e200}));
  EXPECT_FALSE(model.project(Vec2{kNaN, 0.0}));
  EXPECT_FALSE(model.project(Vec2{std::numeric_limits<double>::infinity(), 0.0}));
  EXPECT_FALSE(model.jacobian_px({-1.0, 0.0}));
}

TEST(CameraModel, NothingBehindTheCamera) {
  const CameraModel model = wide_angle_model();
  EXPECT_TRUE(model.project(Vec3{0.01, 0.02, 0.5}));
  EXPECT_FALSE(model.project(Vec3{0.01, 0.02, -0.5}));
  EXPECT_FALSE(model.project(Vec3{0.01, 0.02, 0.0}));
}

TEST(CameraModel, EmptyModelSeesNothing) {
  const CameraModel model;
  EXPECT_FALSE(model.unproject({0.0, 0.0}));
  EXPECT_FALSE(model.project(Vec2{0.0, 0.0}));
  EXPECT_FALSE(model.jacobian_px({0.0, 0.0}));
}

TEST(CameraModel, RefusesBadTablesWithTheReason) {
  EXPECT_THAT(refusal(4, 3, pinhole_table(4, 4, 5.0)), HasSubstr("16 entries"));
  EXPECT_THAT(refusal(0, 3, {}), HasSubstr("0 x 3 px"));
  EXPECT_THAT(refusal(-4, -3, pinhole_table(4, 3, 5.0)), HasSubstr("-4 x -3 px"));
  EXPECT_THAT(refusal(2000000000, 2000000000, {}), HasSubstr("must be 2 to"));
  EXPECT_THAT(refusal(4, 3, std::vector<Vec2>(12, {kNaN, kNaN})), HasSubstr("all NaN"));
  auto infinite = pinhole_table(4, 3, 5.0);
  infinite[6].y = -std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(4, 3, infinite), HasSubstr("infinity at pixel (2, 1)"));
  EXPECT_EQ(refusal(4, 3, pinhole_table(4, 3, 5.0)), "accepted");
}

TEST(CameraModel, RefusesATableThatFolds) {
  auto folded = pinhole_table(8, 8, 10.0);
  folded[3 * 8 + 4].x = folded[3 * 8 + 2].x;  // the fourth column runs back
  EXPECT_THAT(refusal(8, 8, folded), HasSubstr("folds over"));
  EXPECT_THAT(refusal(8, 8, std::vector<Vec2>(64, {0.1, 0.1})), HasSubstr("folds over"));
}

TEST(CameraModel, LonelyPixelsAreNoCamera) {
  auto lonely = pinhole_table(5, 5, 10.0);
  for (std::size_t i = 0; i < lonely.size(); i += 2) {
    lonely[i] = {kNaN, 0.0};
  }
  EXPECT_THAT(refusal(5, 5, lonely), HasSubstr("no four neighbouring"));
}

TEST(CameraModel, NanPixelsSeeNothingAndTheOthersStillWork) {
  auto table = pinhole_table(64, 48, 60.0);
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      if (std::hypot(u - 32, v - 24) > 20) {
        table[static_cast<std::size_t>(v * 64 + u)].y = kNaN;
      }
    }
  }
  const CameraModel model = CameraModel::from_lookup(64, 48, table).value();
  EXPECT_FALSE(model.unproject({2.5, 2.5}));
  EXPECT_FALSE(model.project(Vec2{(2.5 - 32) / 60.0, (2.5 - 24) / 60.0}));
  EXPECT_LT(worst_round_trip_px(model), kInversePx);
  // The rim's own centre is known though its neighbour is not.
  EXPECT_TRUE(model.unproject({52.5, 24.5}));
  EXPECT_FALSE(model.unproject({52.6, 24.5}));
}

TEST(CameraModel, RefusesBadParameters) {
  BrownConrady p = wide_angle();
  p.fx_px = 0.0;
  EXPECT_THAT(CameraModel::from_brown_conrady(p).error().message, HasSubstr("focal length"));
  p = wide_angle();
  p.k2 = kNaN;
  EXPECT_THAT(CameraModel::from_brown_conrady(p).error().message, HasSubstr("not finite"));
  p = wide_angle();
  p.width_px = 1;
  EXPECT_THAT(CameraModel::from_brown_conrady(p).error().message, HasSubstr("1 x 480 px"));
}

TEST(CameraModel, CornersThatAStrongBarrelCannotReachAreInvalid) {
  BrownConrady p = wide_angle();
  p.k1 = -0.3;  // r + k1 r³ peaks at r = 1.054, value 0.703: the corners at 1.1 see nothing
  p.k2 = 0.0;
  const auto model = CameraModel::from_brown_conrady(p);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_FALSE(model->unproject({1.0, 1.0}));
  EXPECT_TRUE(model->unproject({320.0, 240.0}));
}

std::vector<float> floats_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
  return values;
}

/// The device's table stands at integer pixel coordinates, ours at centres half a pixel on: the
/// mean of the four around a centre; the last row and column are continued linearly.
std::vector<Vec2> moved_to_centres(const std::vector<float>& uv2xy, int width, int height) {
  const auto at = [&](int u, int v) {
    const auto i = 2 * static_cast<std::size_t>(v * width + u);
    return Vec2{static_cast<double>(uv2xy[i]), static_cast<double>(uv2xy[i + 1])};
  };
  std::vector<Vec2> table;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const int column = std::min(u, width - 2);
      const int row = std::min(v, height - 2);
      const double s = u - column + 0.5;
      const double t = v - row + 0.5;
      table.push_back((1 - t) * ((1 - s) * at(column, row) + s * at(column + 1, row)) +
                      t * ((1 - s) * at(column, row + 1) + s * at(column + 1, row + 1)));
    }
  }
  return table;
}

TEST(CameraModel, TakesTheFactoryTableOfARealDevice) {
  for (const std::string side : {"leftfront", "rightfront"}) {
    const std::string path = kShared + "/recordings/hololens2-calibration/rm_vlc_" + side;
    if (!std::filesystem::exists(path)) {
      GTEST_SKIP() << "needs shared/recordings/hololens2-calibration";
    }
    const std::vector<float> uv2xy = floats_of(path + "/uv2xy.bin");
    ASSERT_EQ(uv2xy.size(), 640u * 480u * 2u);
    const auto model = CameraModel::from_lookup(640, 480, moved_to_centres(uv2xy, 640, 480));
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_LT(worst_round_trip_px(*model), kInversePx);
    // Integer pixel (320, 240) of the device is the continuous pixel (320, 240) of ours.
    const Vec2 ray = *model->unproject({320.0, 240.0});
    const std::size_t i = 2 * (240 * 640 + 320);
    EXPECT_NEAR(ray.x, static_cast<double>(uv2xy[i]), 1e-5);  // float steps and curvature, 0.004 px
    EXPECT_NEAR(ray.y, static_cast<double>(uv2xy[i + 1]), 1e-5);
  }
}

TEST(CameraModel, TakesTheTablesOfARecording) {
  for (const std::string side : {"LF", "RF"}) {
    const std::string path = kShared + "/recordings/streamrecorder-sample/VLC " + side + "_lut.bin";
    if (!std::filesystem::exists(path)) {
      GTEST_SKIP() << "needs shared/recordings/streamrecorder-sample";
    }
    const std::vector<float> rays = floats_of(path);
    ASSERT_EQ(rays.size(), 640u * 480u * 3u);
    std::vector<Vec2> table;
    for (std::size_t i = 0; i < rays.size(); i += 3) {
      const double z = static_cast<double>(rays[i + 2]);
      table.push_back(
          z > 0.0 ? Vec2{static_cast<double>(rays[i]) / z, static_cast<double>(rays[i + 1]) / z}
                  : Vec2{kNaN, kNaN});
    }
    const auto model = CameraModel::from_lookup(640, 480, std::move(table));
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_LT(worst_round_trip_px(*model), kInversePx);
  }
}

}  // namespace
}  // namespace orthonav
