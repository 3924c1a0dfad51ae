#include <algorithm>
#include <cmath>
#include <filesystem>

#include "render/projection.h"
#include "tests/golden/expected_box.h"
#include "tests/golden/golden_fixture.h"
#include "tests/golden/golden_scene_edit.h"

namespace orthonav::engine {
namespace {

using render::Label;
using ::testing::IsEmpty;

const std::filesystem::path kFolder = ORTHONAV_SOURCE_DIR "/tests/golden/images";

// A centre is the mean of a few hundred pixel centres; what is cut off at the edges moves it less.
constexpr double kCentreTolerance_px = 0.5;

// An edge is told by pixel centres, half a pixel at most from it; a sharp tip is a little farther
// from the last centre that it covers.
constexpr double kEdgeTolerance_px = 0.9;

// Far enough that no hologram covers its points any more.
constexpr PixelStep kAstray = {60, 60};

TEST_P(Golden, LooksAsApproved) {
  const auto expected = read_goldens(kFolder, golden_.name);
  ASSERT_TRUE(expected.ok()) << expected.error().message;
  EXPECT_THAT(differences(*expected, painted(golden_)), IsEmpty())
      << "see: orthonav golden review " << golden_.name;
}

/// Whether the label lies at a point's pixel or at one beside it.
bool covers(const LabelImage& image, Label label, const render::PixelPoint& at) {
  for (int y = static_cast<int>(at.y_px) - 1; y <= static_cast<int>(at.y_px) + 1; ++y) {
    for (int x = static_cast<int>(at.x_px) - 1; x <= static_cast<int>(at.x_px) + 1; ++x) {
      if (x < 0 || y < 0 || x >= image.width_px || y >= image.height_px) {
        continue;
      }
      if (image.labels[static_cast<std::size_t>(y) * image.width_px + x] == label) {
        return true;
      }
    }
  }
  return false;
}

TEST_P(Golden, CoversItsPointsInEveryView) {
  if (golden_.covered.empty()) {
    GTEST_SKIP() << "has no points to cover, its texts have boxes";
  }
  for (const GoldenPoint& point : golden_.covered) {
    const GoldenScene alone = only(golden_, point.label, false);
    const GoldenImages images = painted(alone);
    const GoldenImages astray = painted(moved(alone, point.label, kAstray));
    for (std::size_t view = 0; view < golden_.views.size(); ++view) {
      const auto at =
          render::project(golden_.views[view], point.in_world, golden_.width_px, golden_.height_px);
      ASSERT_TRUE(at);
      EXPECT_TRUE(covers(view_of(images.labels, view), point.label, *at)) << point.label;
      EXPECT_FALSE(covers(view_of(astray.labels, view), point.label, *at)) << point.label;
    }
  }
}

TEST_P(Golden, IsCentredWhereItBelongsAndOnePixelAsideIsNot) {
  if (golden_.centred.empty()) {
    GTEST_SKIP() << "has nothing that is alike on all sides";
  }
  for (const GoldenPoint& point : golden_.centred) {
    const GoldenScene alone = only(golden_, point.label, false);
    const GoldenImages images = painted(alone);
    const GoldenImages aside = painted(moved(alone, point.label, {1, 0}));
    const GoldenImages below = painted(moved(alone, point.label, {0, 1}));
    for (std::size_t view = 0; view < golden_.views.size(); ++view) {
      const auto at =
          render::project(golden_.views[view], point.in_world, golden_.width_px, golden_.height_px);
      const auto is = render::extent_of(view_of(images.labels, view), point.label);
      const auto right = render::extent_of(view_of(aside.labels, view), point.label);
      const auto down = render::extent_of(view_of(below.labels, view), point.label);
      ASSERT_TRUE(at && is && right && down);
      EXPECT_NEAR(is->centre_x_px, at->x_px, kCentreTolerance_px);
      EXPECT_NEAR(is->centre_y_px, at->y_px, kCentreTolerance_px);
      EXPECT_GT(right->centre_x_px - at->x_px, kCentreTolerance_px);
      EXPECT_GT(down->centre_y_px - at->y_px, kCentreTolerance_px);
    }
  }
}

/// How far an extent is from a box, left and top and right and bottom alike.
double distance(const render::LabelExtent& is, const Box& box) {
  return std::max({std::abs(is.left_px - box.left), std::abs(is.right_px - box.right),
                   std::abs(is.top_px - box.top), std::abs(is.bottom_px - box.bottom)});
}

TEST_P(Golden, ReachesAsFarAsItsShapesProject) {
  int checked = 0;
  for (const Label label : labels_in(only_shapes(golden_).scene)) {
    const GoldenScene alone = only(golden_, label, false);
    const GoldenImages images = painted(alone);
    const GoldenImages aside = painted(moved(alone, label, {2, 0}));
    const GoldenImages below = painted(moved(alone, label, {0, 2}));
    for (std::size_t view = 0; view < golden_.views.size(); ++view) {
      const Box box = box_of_shapes(golden_, label, view);
      for (const auto& [labels, fits] :
           {std::pair(&images, true), std::pair(&aside, false), std::pair(&below, false)}) {
        const auto is = render::extent_of(view_of(labels->labels, view), label);
        ASSERT_TRUE(is) << label;
        const double off_px = distance(*is, box);
        EXPECT_EQ(off_px <= kEdgeTolerance_px, fits) << label << ", off by " << off_px;
      }
      ++checked;
    }
  }
  if (checked == 0) {
    GTEST_SKIP() << "is text alone, which has boxes of its own";
  }
}

TEST_P(Golden, WritesEveryTextWhereTheLayoutSays) {
  if (golden_.scene.texts.empty()) {
    GTEST_SKIP() << "has no text";
  }
  for (const render::TextItem& item : golden_.scene.texts) {
    GoldenScene alone = golden_;
    alone.scene = {};
    alone.scene.texts = {item};
    const GoldenImages images = painted(alone);
    for (std::size_t view = 0; view < golden_.views.size(); ++view) {
      const auto is = render::extent_of(view_of(images.labels, view), item.label);
      ASSERT_TRUE(is) << item.label;
      const Box box = box_of_text(golden_, item, view);
      // A texel of the atlas around the ink, half a pixel of rounding, and the end of a thin stroke
      // that lies between two pixel centres.
      constexpr double kTolerance_px = 2;
      EXPECT_NEAR(is->left_px, std::round(box.left), kTolerance_px) << item.label;
      EXPECT_NEAR(is->right_px, std::round(box.right), kTolerance_px) << item.label;
      EXPECT_NEAR(is->top_px, std::round(box.top), kTolerance_px) << item.label;
      EXPECT_NEAR(is->bottom_px, std::round(box.bottom), kTolerance_px) << item.label;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Golden, ::testing::ValuesIn(scene_names()),
                         [](const auto& param) { return param.param; });

TEST(GoldenFolder, HoldsNothingThatBelongsToNoScene) {
  EXPECT_THAT(orphaned_goldens(kFolder, golden_scenes()), IsEmpty());
  std::vector<GoldenScene> fewer = golden_scenes();
  fewer.pop_back();
  EXPECT_EQ(orphaned_goldens(kFolder, fewer).size(), 3u) << "the twin";
}

TEST(GoldenFolder, LacksNothingSilently) {
  EXPECT_FALSE(read_goldens(kFolder, "no_such_scene").ok());
}

TEST(GoldenImages, OfAnotherSizeDiffer) {
  const render::SilentValidation validation;
  GoldenPainter painter(test::test_device(), true, validation.sink());
  GoldenScene scene = golden_scenes().front();
  const auto images = painter.paint(scene);
  ASSERT_TRUE(images.ok()) << images.error().message;
  scene.width_px += 2;
  const auto larger = painter.paint(scene);
  ASSERT_TRUE(larger.ok()) << larger.error().message;
  EXPECT_THAT(differences(*images, *larger),
              ::testing::ElementsAre("labels: sizes differ", "additive: sizes differ",
                                     "over: sizes differ"));
}

TEST(GoldenScenes, AreTheSameAtEveryCall) {
  const std::vector<GoldenScene> first = golden_scenes();
  const std::vector<GoldenScene> second = golden_scenes();
  const render::SilentValidation validation;
  GoldenPainter painter(test::test_device(), true, validation.sink());
  const auto a = painter.paint(first.back());
  const auto b = painter.paint(second.back());
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_EQ(a->additive, b->additive);
  EXPECT_EQ(a->labels, b->labels);
}

}  // namespace
}  // namespace orthonav::engine
