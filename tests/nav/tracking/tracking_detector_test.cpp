#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/random.h"
#include "nav/tracking/marker_detector.h"
#include "nav/tracking/tool.h"
#include "tests/support/tag_scene.h"

namespace orthonav::nav {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// The library snaps edges that run along the pixel rows by up to a quarter of a pixel in either
// direction (measured), 0.05 px RMS for edges that do not. Half a pixel, the mistake to be found,
// would be 0.7 px at a corner and 0.5 px in the mean.
constexpr double kAlignedCornerPx = 0.35;
constexpr double kCornerRmsPx = 0.07;
constexpr double kCornerMeanPx = 0.02;
// Measured 0.03 with noise of 3 grey levels.
constexpr double kEdgesRmsPx = 0.04;
// A box changes the order of sums in the library, no more.
constexpr double kSamePx = 1e-3;

MarkerDetector detector(DetectorOptions options = {}) {
  auto made = MarkerDetector::create(options);
  if (!made) {
    throw std::runtime_error(made.error().message);
  }
  return std::move(made).value();
}

std::string refusal(const DetectorOptions& options) {
  auto made = MarkerDetector::create(options);
  return made ? "" : made.error().message;
}

double worst_px(const std::array<Vec2, 4>& a, const std::array<Vec2, 4>& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    worst = std::max(worst, (a[i] - b[i]).norm());
  }
  return worst;
}

class EveryFamily : public ::testing::TestWithParam<std::string_view> {};

TEST_P(EveryFamily, IsDetectedWithItsCornersInOrder) {
  const std::string family(GetParam());
  const test::TagPicture tag = test::tag_picture(family, 7);
  const double cell_px = 9.3;
  const double edge_px = cell_px * (tag.cells - 2 * tag.border_cells);
  const Vec2 corner{70.37, 61.81};
  auto d = detector({.families = {family}});
  std::vector<MarkerCorners> found;
  ASSERT_TRUE(d.detect(test::flat_picture(family, 7, 240, 220, corner, cell_px), found));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].family, family);
  EXPECT_EQ(found[0].id, 7);
  EXPECT_EQ(found[0].hamming, 0);
  // Bottom left first, then as Marker coordinates run; continuous pixels.
  const std::array<Vec2, 4> expected = {corner + Vec2{0, edge_px}, corner + Vec2{edge_px, edge_px},
                                        corner + Vec2{edge_px, 0}, corner};
  EXPECT_LT(worst_px(found[0].corners_px, expected), kAlignedCornerPx);
}

TEST_P(EveryFamily, HasTheNumberOfIdsSaid) {
  const std::string family(GetParam());
  ToolGeometry tool{"t", ToolRole::kPointer, {family, family_size(family) - 1, 0.05}, {}, {}, {}};
  tool.axis_in_marker = {{0, 1, 0}};
  EXPECT_THAT(problems_of({tool}), IsEmpty());
  EXPECT_GT(test::tag_picture(family, family_size(family) - 1).cells, 0);
  ++tool.marker.id;
  EXPECT_THAT(problems_of({tool}), SizeIs(1));
}

INSTANTIATE_TEST_SUITE_P(MarkerDetector, EveryFamily, ::testing::ValuesIn(known_families()),
                         [](const auto& each) { return std::string(each.param); });

struct CornerErrors {
  Vec2 mean_px;
  double rms_px = 0.0;  ///< of one coordinate
};

// Of each refinement, on tags of two sizes all over the image, turned every way, with this much
// noise.
std::map<Refinement, CornerErrors> corner_errors(const std::vector<Refinement>& refinements,
                                                 double noise_sd) {
  const auto calibration = test::test_calibration();
  const auto from_left = calibration.left_from_rig.inverse();
  Random random(11);
  std::map<Refinement, CornerErrors> errors;
  constexpr int kPictures = 40;
  for (int k = 0; k < kPictures; ++k) {
    const test::PlacedTag tag{"tag36h11", 3, k % 2 ? 0.05 : 0.03,
                              test::facing({0.003 * k - 0.05, 0.002 * k - 0.03, 0.001 * k},
                                           {0.02 * k - 0.4, 0.3 - 0.017 * k, 0.1 + 0.16 * k})};
    auto image =
        test::picture(calibration.left, {from_left.rotation(), from_left.translation()}, {tag});
    for (auto& p : image.pixels) {
      p = static_cast<std::uint8_t>(std::clamp(p + random.normal(0, noise_sd), 0.0, 255.0));
    }
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

TEST(MarkerDetector, ReadsAnAprilGridWithItsBordersTwoCellsWide) {
  constexpr double kSpacing = 0.3;
  for (const double cell_px : {3.1, 6.4}) {
    const auto image = test::april_grid_picture(4, 3, cell_px, kSpacing);
    auto d = detector({.families = {"tag36h11b2"}, .refinement = Refinement::kEdges});
    std::vector<MarkerCorners> found;
    ASSERT_TRUE(d.detect(image, found));
    ASSERT_THAT(found, SizeIs(12));
    const double edge_px = 10 * cell_px;
    for (int id = 0; id < 12; ++id) {
      const MarkerCorners& tag = found[static_cast<std::size_t>(id)];
      EXPECT_EQ(tag.id, id);
      EXPECT_EQ(tag.hamming, 0);
      const Vec2 corner{edge_px * (kSpacing + (1 + kSpacing) * (id % 4)),
                        edge_px * (kSpacing + (1 + kSpacing) * (id / 4))};
      EXPECT_LT(
          worst_px(tag.corners_px, {corner + Vec2{0, edge_px}, corner + Vec2{edge_px, edge_px},
                                    corner + Vec2{edge_px, 0}, corner}),
          kAlignedCornerPx);
    }
    ASSERT_TRUE(detector().detect(image, found));
    EXPECT_THAT(found, IsEmpty()) << "the plain family must not read wide borders";
  }
}

TEST(MarkerDetector, TellsWideBordersFromPlainOnes) {
  auto both = detector({.families = {"tag36h11", "tag36h11b2"}});
  std::vector<MarkerCorners> found;
  for (const char* family : {"tag36h11", "tag36h11b2"}) {
    ASSERT_TRUE(both.detect(test::flat_picture(family, 5, 200, 200, {50, 50}, 9.0), found));
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_EQ(found[0].family, family);
    EXPECT_EQ(found[0].id, 5);
  }
  auto wide = detector({.families = {"tag36h11b2"}, .max_hamming = 2});
  for (int id = 0; id < 60; ++id) {
    ASSERT_TRUE(
        wide.detect(test::flat_picture("tag36h11", id, 140, 140, {33.3, 34.4}, 9.0), found));
    EXPECT_THAT(found, IsEmpty()) << "a plain tag read with a size that it does not have: " << id;
  }
}

TEST(MarkerDetector, SeesTwoFamiliesAtOnce) {
  auto d = detector({.families = {"tag36h11", "tag25h9"}});
  std::vector<MarkerCorners> found;
  for (const char* family : {"tag36h11", "tag25h9"}) {
    ASSERT_TRUE(d.detect(test::flat_picture(family, 5, 200, 200, {60, 60}, 9.0), found));
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_EQ(found[0].family, family);
  }
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

// A busy picture with three tags for boxes.
GreyImage three_tags(const std::vector<test::PlacedTag>& tags) {
  const auto calibration = test::test_calibration();
  const auto from_left = calibration.left_from_rig.inverse();
  auto image =
      test::picture(calibration.left, {from_left.rotation(), from_left.translation()}, tags);
  Random random(5);
  for (auto& p : image.pixels) {
    p = static_cast<std::uint8_t>(std::clamp(p + random.normal(0, 3), 0.0, 255.0));
  }
  return image;
}

TEST(MarkerDetector, ABoxGivesTheSameCornersAsTheWholeImage) {
  const auto calibration = test::test_calibration();
  const std::vector<test::PlacedTag> tags = {
      {"tag36h11", 3, 0.05, test::facing({0.0, 0.02, 0.0}, {0.3, -0.4, 0.2})},
      {"tag36h11", 5, 0.07, test::facing({-0.09, -0.05, 0.05}, {-0.2, 0.3, 1.9})},
      {"tag36h11", 17, 0.04, test::facing({0.05, 0.1, -0.1}, {0.1, 0.5, -2.5})}};
  const GreyImage image = three_tags(tags);
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

TEST(MarkerDetector, ABoxBesideTheImageShowsNothing) {
  const auto image = test::flat_picture("tag36h11", 3, 200, 200, {60, 60}, 10.0);
  auto d = detector();
  constexpr int kFar = 2'000'000'000;
  for (const PixelBox box :
       {PixelBox{300, 300, 50, 50}, PixelBox{-80, -80, 50, 50}, PixelBox{10, 10, 0, 50},
        PixelBox{10, 10, -5, 50}, PixelBox{kFar, kFar, kFar, kFar}, PixelBox{199, 199, 1, 1},
        PixelBox{-kFar, -kFar, 5, 5}}) {
    std::vector<MarkerCorners> found(1);
    EXPECT_TRUE(d.detect(image, box, found));
    EXPECT_THAT(found, IsEmpty());
  }
  std::vector<MarkerCorners> found;
  EXPECT_TRUE(d.detect(image, {-kFar, -kFar, kFar, kFar}, found));
  EXPECT_THAT(found, IsEmpty());
  EXPECT_TRUE(d.detect(image, {-50, -50, kFar, kFar}, found));
  EXPECT_THAT(found, SizeIs(1));
}

TEST(MarkerDetector, TakesImagesOfAnySize) {
  Random random(9);
  auto d = detector();
  std::vector<MarkerCorners> found;
  for (int width = 1; width < 40; width += 3) {
    for (int height = 1; height < 40; height += 4) {
      GreyImage image(width, height);
      for (auto& p : image.pixels) {
        p = static_cast<std::uint8_t>(random.next());
      }
      EXPECT_TRUE(d.detect(image, found));
      EXPECT_THAT(found, IsEmpty());
    }
  }
}

TEST(MarkerDetector, RefusesImagesThatAreNone) {
  auto d = detector();
  std::vector<MarkerCorners> found(2);
  EXPECT_THAT(d.detect(GreyImage(), found).error().message, HasSubstr("empty (0 x 0 px)"));
  EXPECT_THAT(found, IsEmpty());
  GreyImage negative(4, 4);
  negative.width_px = -4;
  EXPECT_THAT(d.detect(negative, found).error().message, HasSubstr("empty"));
  GreyImage cut(64, 64);
  cut.pixels.resize(4000);
  EXPECT_THAT(d.detect(cut, found).error().message,
              HasSubstr("64 x 64 px holds 4000 bytes, 4096 expected"));
  GreyImage wide(40000, 1);
  EXPECT_THAT(d.detect(wide, found).error().message, HasSubstr("limit 32767"));
}

TEST(MarkerDetector, RefusesBadOptions) {
  EXPECT_THAT(refusal({.families = {"tag36h12"}}),
              ::testing::AllOf(HasSubstr("unknown tag family 'tag36h12'"), HasSubstr("tag36h11"),
                               HasSubstr("tagCircle21h7")));
  EXPECT_THAT(refusal({.families = {}}), HasSubstr("no tag family"));
  EXPECT_THAT(refusal({.families = {"tag36h11", "tag36h11"}}), HasSubstr("twice"));
  EXPECT_THAT(refusal({.decimate = 0.5}), HasSubstr("decimate"));
  EXPECT_THAT(refusal({.decimate = std::nan("")}), HasSubstr("decimate"));
  EXPECT_THAT(refusal({.max_hamming = 3}), HasSubstr("max_hamming 3"));
  EXPECT_THAT(refusal({.families = {"tagStandard52h13"}, .max_hamming = 2}),
              HasSubstr("at most 1"));
  EXPECT_THAT(refusal({.min_decision_margin = std::nan("")}), HasSubstr("not finite"));
  EXPECT_THAT(refusal({.threads = 0}), HasSubstr("0 threads"));
  EXPECT_EQ(refusal({}), "");
}

TEST(MarkerDetector, LeavesOutWhatIsDecodedBadly) {
  auto image = test::flat_picture("tag36h11", 3, 200, 200, {60, 60}, 10.0);
  auto corrected = image;
  for (int y = 71; y < 80; ++y) {  // one bit turned over
    for (int x = 71; x < 80; ++x) {
      corrected.at(x, y) = static_cast<std::uint8_t>(250 - corrected.at(x, y));
    }
  }
  std::vector<MarkerCorners> found;
  ASSERT_TRUE(detector({.max_hamming = 1}).detect(corrected, found));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].hamming, 1);
  ASSERT_TRUE(detector({.max_hamming = 0}).detect(corrected, found));
  EXPECT_THAT(found, IsEmpty());
  ASSERT_TRUE(detector({.min_decision_margin = 250.0}).detect(image, found));
  EXPECT_THAT(found, IsEmpty());
}

}  // namespace
}  // namespace orthonav::nav
