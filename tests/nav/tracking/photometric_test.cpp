// The photometric pose on tags drawn by the tests' own ray caster, and its parts.
#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Dense>

#include "base/random.h"
#include "nav/tracking/photometric_pose.h"
#include "tests/support/tag_picture.h"
#include "tests/support/tag_scene.h"

namespace orthonav::nav::photometric_test {
namespace {

constexpr double kTagM = 0.05;
/// The error from whole greys, 64 rays a pixel and the caster's square blur; corners are ten times
/// worse.
constexpr double kExactTipM = 0.00008;
constexpr double kExactRotationRad = 0.0006;

const Point<Marker> kTip{{0.0, -0.15, 0.0}};

struct Shown {
  StereoCalibration calibration = test::test_calibration();
  test::PlacedTag tag;
  StereoFrame frame;

  explicit Shown(const Transform<Rig, Marker>& pose, const std::string& family = "tag36h11",
                 int id = 3)
      : tag{family, id, kTagM, pose}, frame(test::stereo_frame(calibration, {tag}, {})) {}
};

Transform<Rig, Marker> tilted() { return test::facing({0.01, 0.02, 0.0}, {0.3, -0.25, 0.4}); }

/// Off by a millimetre and a degree or so.
Transform<Rig, Marker> roughly(const Transform<Rig, Marker>& pose) {
  return pose * Transform<Marker, Marker>(rotation_from_vector({0.02, -0.015, 0.01}),
                                          {0.0007, -0.0006, 0.0012});
}

std::vector<TagView> both_views(const BlurredTag& tag) {
  std::vector<TagView> views(2);
  for (TagView& view : views) {
    view.tag = &tag;
  }
  views[1].right = true;
  return views;
}

BlurredTag drawn(const std::string& family = "tag36h11", int id = 3) {
  return {tag_template(family, id).value(), kTagM};
}

void add_noise(GreyImage& image, double sd, Random& random) {
  for (std::uint8_t& grey : image.pixels) {
    grey = static_cast<std::uint8_t>(std::clamp(grey + random.normal(0.0, sd) + 0.5, 0.0, 255.0));
  }
}

double tip_error_m(const Transform<Rig, Marker>& pose, const Transform<Rig, Marker>& truth) {
  return (pose * kTip - truth * kTip).norm();
}

double nees(const PhotometricFit& fit, const Transform<Rig, Marker>& truth) {
  const Transform<Marker, Marker> error = truth.inverse() * fit.rig_from_marker;
  const Vec3 translation_m = error.translation();
  const Vec3 rotation_rad = vector_from_rotation(error.rotation());
  Eigen::Matrix<double, 6, 1> e;
  e << translation_m.x, translation_m.y, translation_m.z, rotation_rad.x, rotation_rad.y,
      rotation_rad.z;
  const Eigen::Map<const Eigen::Matrix<double, 6, 6>> covariance(fit.covariance.data());
  return e.dot(covariance.ldlt().solve(e));
}

TEST(PhotometricPose, IsExactWhereTheImagesAre) {
  const Shown shown(tilted());
  const BlurredTag tag = drawn();
  PhotometricSolver solver(shown.calibration);
  auto views = both_views(tag);
  const auto fit = solver.solve(shown.frame, roughly(tilted()), 0.001, views);
  ASSERT_TRUE(fit.has_value());
  EXPECT_EQ(fit->views, 2);
  EXPECT_LT(tip_error_m(fit->rig_from_marker, tilted()), kExactTipM);
  EXPECT_LT(rotation_angle_rad(fit->rig_from_marker.rotation(), tilted().rotation()),
            kExactRotationRad);
  // The control: the starting pose is beyond the bound.
  EXPECT_GT(tip_error_m(roughly(tilted()), tilted()), 10.0 * kExactTipM);
}

TEST(PhotometricPose, FindsTheLightAndTheBlurByItself) {
  Shown shown(tilted());
  for (GreyImage* image : {&shown.frame.left, &shown.frame.right}) {
    for (std::uint8_t& grey : image->pixels) {
      grey = static_cast<std::uint8_t>(20 + grey / 4);
    }
  }
  const BlurredTag tag = drawn();
  PhotometricSolver solver(shown.calibration);
  auto views = both_views(tag);
  const auto fit = solver.solve(shown.frame, roughly(tilted()), 0.001, views);
  ASSERT_TRUE(fit.has_value());
  // Black 20 and white 230 became 25 and 77.5.
  EXPECT_NEAR(views[0].light.black, 25.0, 1.5);
  EXPECT_NEAR(views[0].light.contrast, 52.5, 2.0);
  // A square of two pixels has an SD of 0.58 px; a cell of this tag is about 5.6 px wide.
  EXPECT_NEAR(views[0].light.blur_cells[0], 0.105, 0.03);
  EXPECT_LT(views[0].light.excess_kurtosis[0], 0.0) << "a square has no tails";
  EXPECT_LT(tip_error_m(fit->rig_from_marker, tilted()), 3.0 * kExactTipM);
}

TEST(PhotometricPose, IsNotMisledByASensorThatIsNoLine) {
  // As of a camera that encodes grey for a screen: white areas grow by a part of the blur.
  Shown shown(tilted());
  for (GreyImage* image : {&shown.frame.left, &shown.frame.right}) {
    for (std::uint8_t& grey : image->pixels) {
      grey = static_cast<std::uint8_t>(250.0 * std::pow(grey / 250.0, 1.0 / 2.2) + 0.5);
    }
  }
  const BlurredTag tag = drawn();
  PhotometricSolver solver(shown.calibration);
  auto views = both_views(tag);
  const auto fit = solver.solve(shown.frame, roughly(tilted()), 0.001, views);
  ASSERT_TRUE(fit.has_value());
  EXPECT_GT(views[0].light.response[0], 0.3);
  EXPECT_LT(tip_error_m(fit->rig_from_marker, tilted()), 3.0 * kExactTipM);
  EXPECT_NEAR(fit->rig_from_marker.translation().z, tilted().translation().z, 0.00003);
}

TEST(PhotometricPose, GoesOnWhenAPartIsHidden) {
  Shown shown(tilted());
  const BlurredTag tag = drawn();
  PhotometricSolver solver(shown.calibration);
  auto views = both_views(tag);
  ASSERT_TRUE(solver.solve(shown.frame, tilted(), 0.001, views)) << "the light is known then";
  const auto cover = [&](GreyImage& image, const std::array<Vec2, 4>& corners) {
    const Vec2 middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    for (int y = 0; y < image.height_px; ++y) {
      for (int x = 0; x < image.width_px; ++x) {
        if (x > middle.x + 6.0) {
          image.at(x, y) = 120;
        }
      }
    }
  };
  cover(shown.frame.left, test::left_corners(shown.calibration, shown.tag));
  cover(shown.frame.right, test::right_corners(shown.calibration, shown.tag));
  const auto fit = solver.solve(shown.frame, roughly(tilted()), 0.001, views);
  ASSERT_TRUE(fit.has_value());
  EXPECT_LT(views[0].kept_fraction, 0.9);
  EXPECT_LT(tip_error_m(fit->rig_from_marker, tilted()), 6.0 * kExactTipM);
}

TEST(PhotometricPose, OneCameraIsLessSure) {
  const Shown shown(tilted());
  const BlurredTag tag = drawn();
  PhotometricSolver solver(shown.calibration);
  auto views = both_views(tag);
  const auto both = solver.solve(shown.frame, roughly(tilted()), 0.001, views);
  std::vector<TagView> left(1);
  left[0].tag = &tag;
  const auto one = solver.solve(shown.frame, roughly(tilted()), 0.001, left);
  ASSERT_TRUE(both && one);
  EXPECT_TRUE(one->left);
  EXPECT_FALSE(one->right);
  const auto variance = [](const PhotometricFit& fit) {
    return fit.covariance[0] + fit.covariance[7] + fit.covariance[14];
  };
  EXPECT_GT(variance(*one), 4.0 * variance(*both));
}

TEST(PhotometricPose, SaysHowFarItMayBeOff) {
  const BlurredTag tag = drawn();
  Random random(11);
  double sum = 0.0;
  constexpr int kPoses = 40;
  for (int i = 0; i < kPoses; ++i) {
    const Transform<Rig, Marker> pose =
        test::facing({random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), 0.0},
                     {random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(-3, 3)});
    Shown shown(pose);
    add_noise(shown.frame.left, 4.0, random);
    add_noise(shown.frame.right, 4.0, random);
    PhotometricSolver solver(shown.calibration);
    auto views = both_views(tag);
    std::optional<PhotometricFit> fit;
    // The second time the noise is known.
    for (int k = 0; k < 3; ++k) {
      fit = solver.solve(shown.frame, pose, 0.0005, views);
    }
    ASSERT_TRUE(fit.has_value());
    sum += nees(*fit, pose);
  }
  // A chi-square of 6 degrees of freedom averages 6; of 40 draws within 1.1 (2 SD) of it. The
  // caster's square blur is an error of the model, of which the covariance knows a part: up to 9.
  EXPECT_GT(sum / kPoses, 4.5);
  EXPECT_LT(sum / kPoses, 9.0);
}

TEST(PhotometricPose, SeesNothingWhereThereIsNoTag) {
  Shown shown(tilted());
  std::fill(shown.frame.left.pixels.begin(), shown.frame.left.pixels.end(), 110);
  std::fill(shown.frame.right.pixels.begin(), shown.frame.right.pixels.end(), 110);
  const BlurredTag tag = drawn();
  PhotometricSolver solver(shown.calibration);
  auto views = both_views(tag);
  EXPECT_FALSE(solver.solve(shown.frame, tilted(), 0.001, views).has_value());
}

class EveryTemplate : public ::testing::TestWithParam<const char*> {};
TEST_P(EveryTemplate, IsWhatTheLibraryDraws) {
  const TagTemplate tag = tag_template(GetParam(), 3).value();
  const test::TagPicture picture = test::tag_picture(GetParam(), 3);
  ASSERT_EQ(tag.cells, picture.cells);
  EXPECT_EQ(tag.border_cells, picture.cells - 2 * picture.border_cells);
  for (int row = 0; row < tag.cells; ++row) {
    for (int column = 0; column < tag.cells; ++column) {
      EXPECT_EQ(tag.at(row, column) > 0.5F,
                picture.white[static_cast<std::size_t>(row * tag.cells + column)])
          << row << ", " << column;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Families, EveryTemplate,
                         ::testing::Values("tag36h11", "tag36h10", "tagStandard41h12", "tag25h9"));

TEST(TagTemplate, RefusesWhatDoesNotExist) {
  EXPECT_FALSE(tag_template("tag36h12", 0).has_value());
  EXPECT_FALSE(tag_template("tag36h11", 587).has_value());
  EXPECT_FALSE(tag_template("tag36h11", -1).has_value());
}

TEST(TagTemplate, HasAWiderBorderWhereTheNameSaysSo) {
  const TagTemplate plain = tag_template("tag36h11", 7).value();
  const TagTemplate wide = tag_template("tag36h11b2", 7).value();
  ASSERT_EQ(wide.border_cells, 10);
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < 6; ++k) {
      EXPECT_EQ(wide.at(i + 3, k + 3), plain.at(i + 2, k + 2));
    }
  }
  for (int i = 1; i < 11; ++i) {
    EXPECT_EQ(wide.at(2, i), 0.0F);
    EXPECT_EQ(wide.at(1, i), 0.0F);
    EXPECT_EQ(wide.at(0, i), 1.0F);
  }
}

}  // namespace
}  // namespace orthonav::nav::photometric_test
