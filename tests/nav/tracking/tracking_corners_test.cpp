#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/random.h"
#include "tests/nav/tracking/tag_corners.h"
#include "tests/support/tag_picture.h"
#include "tests/support/tag_scene.h"

namespace orthonav::nav::detector_test {
namespace {

using ::testing::SizeIs;

// Measured 0.05 px RMS where edges do not run along the pixel rows. Half a pixel, the mistake to be
// found, would be 0.5 px in the mean.
constexpr double kCornerRmsPx = 0.07;
constexpr double kCornerMeanPx = 0.02;
// Measured 0.03 with noise of 3 grey levels.
constexpr double kEdgesRmsPx = 0.04;
// A box changes the order of sums in the library, no more.
constexpr double kSamePx = 1e-3;

struct CornerErrors {
  Vec2 mean_px;
  double rms_px = 0.0;  ///< of one coordinate
};

GreyImage noisy_picture(const StereoCalibration& calibration,
                        const std::vector<test::PlacedTag>& tags, double noise_sd, Random& random) {
  const auto from_left = calibration.left_from_rig.inverse();
  auto image =
      test::picture(calibration.left, {from_left.rotation(), from_left.translation()}, tags);
  for (auto& p : image.pixels) {
    p = static_cast<std::uint8_t>(std::clamp(p + random.normal(0, noise_sd), 0.0, 255.0));
  }
  return image;
}

// Of each refinement, on tags of two sizes all over the image, turned every way, with this much
// noise.
std::map<Refinement, CornerErrors> corner_errors(const std::vector<Refinement>& refinements,
                                                 double noise_sd) {
  const auto calibration = test::test_calibration();
  Random random(11);
  std::map<Refinement, CornerErrors> errors;
  constexpr int kPictures = 40;
  for (int k = 0; k < kPictures; ++k) {
    const test::PlacedTag tag{"tag36h11", 3, k % 2 ? 0.05 : 0.03,
                              test::facing({0.003 * k - 0.05, 0.002 * k - 0.03, 0.001 * k},
                                           {0.02 * k - 0.4, 0.3 - 0.017 * k, 0.1 + 0.16 * k})};
    const GreyImage image = noisy_picture(calibration, {tag}, noise_sd, random);
    const auto truth = left_corners(calibration, tag);
    // The noise all around is the detector's slow part; what it sees in a box is tested elsewhere.
    const PixelBox around{static_cast<int>(truth[0].x) - 80, static_cast<int>(truth[0].y) - 80, 160,
                          160};
    for (const Refinement refinement : refinements) {
      std::vector<MarkerCorners> found;
      EXPECT_TRUE(detector({.refinement = refinement}).detect(image, around, found));
      EXPECT_THAT(found, SizeIs(1));
      if (found.size() != 1) {
        continue;
      }
      CornerErrors& sum = errors[refinement];
      for (std::size_t i = 0; i < 4; ++i) {
        const Vec2 error = found[0].corners_px[i] - truth[i];
        sum.mean_px = sum.mean_px + (1.0 / (4 * kPictures)) * error;
        sum.rms_px += error.dot(error) / (8 * kPictures);
      }
    }
  }
  for (auto& [refinement, sum] : errors) {
    sum.rms_px = std::sqrt(sum.rms_px);
  }
  return errors;
}

TEST(MarkerDetector, CornersFollowThePixelConvention) {
  const auto all = corner_errors({Refinement::kLibrary, Refinement::kEdges}, 0.0);
  ASSERT_THAT(all, SizeIs(2));
  for (const auto& [refinement, errors] : all) {
    EXPECT_LT(std::abs(errors.mean_px.x), kCornerMeanPx);
    EXPECT_LT(std::abs(errors.mean_px.y), kCornerMeanPx);
    EXPECT_LT(errors.rms_px, kCornerRmsPx);
  }
}

TEST(MarkerDetector, RefinesEdgesBetterThanTheLibrary) {
  auto errors = corner_errors({Refinement::kEdges, Refinement::kLibrary, Refinement::kNone}, 3.0);
  const double edges_px = errors[Refinement::kEdges].rms_px;
  const double library_px = errors[Refinement::kLibrary].rms_px;
  const double none_px = errors[Refinement::kNone].rms_px;
  ASSERT_GT(edges_px, 0.0);
  EXPECT_LT(edges_px, kEdgesRmsPx);
  EXPECT_LT(edges_px, 0.7 * library_px);
  EXPECT_LT(library_px, 0.7 * none_px) << "what is not refined is seen to be worse";
}

TEST(MarkerDetector, DecimationKeepsThePlaceOfTheCorners) {
  const auto image = test::flat_picture("tag36h11", 3, 240, 240, {60.4, 61.7}, 12.0);
  std::vector<MarkerCorners> found;
  for (const double decimate : {1.5, 2.0, 3.0}) {
    auto d = detector({.decimate = decimate});
    ASSERT_TRUE(d.detect(image, found));
    ASSERT_THAT(found, SizeIs(1)) << decimate;
    EXPECT_LT((found[0].corners_px[3] - Vec2{60.4, 61.7}).norm(), 0.3) << decimate;
  }
}

TEST(MarkerDetector, ABoxGivesTheSameCornersAsTheWholeImage) {
  const auto calibration = test::test_calibration();
  const std::vector<test::PlacedTag> tags = {
      {"tag36h11", 3, 0.05, test::facing({0.0, 0.02, 0.0}, {0.3, -0.4, 0.2})},
      {"tag36h11", 5, 0.07, test::facing({-0.09, -0.05, 0.05}, {-0.2, 0.3, 1.9})},
      {"tag36h11", 17, 0.04, test::facing({0.05, 0.1, -0.1}, {0.1, 0.5, -2.5})}};
  Random random(5);
  const GreyImage image = noisy_picture(calibration, tags, 3.0, random);
  for (const double decimate : {1.0, 1.5, 2.0}) {
    auto d = detector({.decimate = decimate});
    std::vector<MarkerCorners> whole;
    std::vector<MarkerCorners> boxed;
    ASSERT_TRUE(d.detect(image, whole));
    ASSERT_THAT(whole, SizeIs(3)) << decimate;
    for (const MarkerCorners& marker : whole) {
      for (int offset = 0; offset < 4; ++offset) {
        Vec2 low{1e9, 1e9};
        Vec2 high{-1e9, -1e9};
        for (const Vec2 c : marker.corners_px) {
          low = {std::min(low.x, c.x), std::min(low.y, c.y)};
          high = {std::max(high.x, c.x), std::max(high.y, c.y)};
        }
        const PixelBox box{
            static_cast<int>(low.x) - 16 - offset, static_cast<int>(low.y) - 19 + offset,
            static_cast<int>(high.x - low.x) + 36, static_cast<int>(high.y - low.y) + 38};
        ASSERT_TRUE(d.detect(image, box, boxed));
        ASSERT_THAT(boxed, SizeIs(1)) << marker.id << " decimated by " << decimate;
        EXPECT_EQ(boxed[0].id, marker.id);
        EXPECT_EQ(boxed[0].hamming, marker.hamming);
        EXPECT_LT(worst_px(boxed[0].corners_px, marker.corners_px), kSamePx);
      }
    }
  }
  EXPECT_LT(worst_px(left_corners(calibration, tags[0]),
                     [&] {
                       std::vector<MarkerCorners> whole;
                       EXPECT_TRUE(detector().detect(image, whole));
                       return whole.at(0).corners_px;
                     }()),
            0.3);
}

}  // namespace
}  // namespace orthonav::nav::detector_test
