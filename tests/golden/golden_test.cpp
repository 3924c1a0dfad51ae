#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>

#include "engine/golden/golden_images.h"
#include "render/projection.h"
#include "tests/golden/expected_box.h"
#include "tests/golden/golden_image_edit.h"
#include "tests/golden/golden_scene_edit.h"
#include "tests/render/silent_validation.h"

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

// Far enough that no hologram still covers its points.
constexpr PixelStep kAstray = {60, 60};

class Golden : public ::testing::TestWithParam<std::string> {
 protected:
  // One painter for all: a device and its shaders take longer than a picture.
  static void SetUpTestSuite() {
    validation_ = std::make_unique<render::SilentValidation>();
    painter_ =
        std::make_unique<GoldenPainter>(GoldenPainter::kPinnedDevice, true, validation_->sink());
    spoiler_ = std::make_unique<GoldenPainter>(GoldenPainter::kPinnedDevice);
  }
  static void TearDownTestSuite() {
    painter_.reset();
    spoiler_.reset();
    validation_.reset();
  }
  void SetUp() override {
    static const std::vector<GoldenScene> kScenes = golden_scenes();
    for (const GoldenScene& scene : kScenes) {
      if (scene.name == GetParam()) {
        golden_ = scene;
      }
    }
    ASSERT_EQ(golden_.name, GetParam());
  }
  GoldenImages painted(const GoldenScene& scene) { return painted_by(*painter_, scene); }
  /// Without a layer that listens: of scenes as they should be it hears all.
  GoldenImages spoilt(const GoldenScene& scene) { return painted_by(*spoiler_, scene); }
  static GoldenImages painted_by(GoldenPainter& painter, const GoldenScene& scene) {
    Result<GoldenImages> images = painter.paint(scene);
    EXPECT_TRUE(images.ok()) << images.error().message;
    return images.ok() ? std::move(*images) : GoldenImages{};
  }
  /// Labels of one view out of the views side by side.
  LabelImage view_of(const LabelImage& joined, std::size_t view) const {
    LabelImage one{golden_.width_px, golden_.height_px, {}};
    for (int y = 0; y < one.height_px; ++y) {
      const auto begin = joined.labels.begin() + y * joined.width_px +
                         static_cast<std::ptrdiff_t>(view) * one.width_px;
      one.labels.insert(one.labels.end(), begin, begin + one.width_px);
    }
    return one;
  }
  GoldenScene golden_;
  void TearDown() override { EXPECT_THAT(painter_->validation_messages(), IsEmpty()); }

  static std::unique_ptr<render::SilentValidation> validation_;
  static std::unique_ptr<GoldenPainter> painter_;
  static std::unique_ptr<GoldenPainter> spoiler_;
};

std::unique_ptr<render::SilentValidation> Golden::validation_;
std::unique_ptr<GoldenPainter> Golden::painter_;
std::unique_ptr<GoldenPainter> Golden::spoiler_;

TEST_P(Golden, LooksAsApproved) {
  const auto expected = read_goldens(kFolder, golden_.name);
  ASSERT_TRUE(expected.ok()) << expected.error().message;
  EXPECT_THAT(differences(*expected, painted(golden_)), IsEmpty())
      << "see: orthonav golden review " << golden_.name;
}

/// How many of the spoilt pictures the comparison noticed, of how many.
struct Caught {
  int all = 0;
  int noticed = 0;
  /// A picture counts when labels (where they must differ) and both kinds of colour differ.
  void count(const GoldenImages& good, const GoldenImages& spoilt, bool labels_differ = true) {
    ++all;
    if (render::compare_labels(good.labels, spoilt.labels).alike() != labels_differ &&
        !render::compare_colour(good.additive, spoilt.additive).alike() &&
        !render::compare_colour(good.over, spoilt.over).alike()) {
      ++noticed;
    }
  }
  [[nodiscard]] std::string cell() const {
    return all == 0 ? "-" : std::to_string(noticed) + " of " + std::to_string(all);
  }
};

/// The table of docs/golden-images.md that says which spoilt pictures are noticed.
std::string line_of_table(const std::string& scene) {
  std::ifstream file(ORTHONAV_SOURCE_DIR "/docs/golden-images.md");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("| `" + scene + "` |")) {
      return line;
    }
  }
  return {};
}

/// Scenes whose spoilt pictures are drawn too: a picture for every hologram and number of a scene.
class GoldenControls : public Golden {};

TEST_P(GoldenControls, AreNoticedAllAsTheTableSays) {
  const GoldenImages good = painted(golden_);
  Caught hidden;
  Caught shifted;
  Caught dim;
  Caught digit;
  Caught mirror;
  Caught swapped;
  for (const Label label : labels_in(golden_.scene)) {
    hidden.count(good, spoilt(without(golden_, label)));
    shifted.count(good, spoilt(moved(golden_, label, {1, 0})));
    dim.count(good, spoilt(dimmed(golden_, label)), false);
  }
  for (const GoldenScene& other : with_one_number_changed(golden_)) {
    digit.count(good, spoilt(other));
  }
  const auto views = static_cast<int>(golden_.views.size());
  mirror.count(good, mirrored(good, views));
  if (views == 2) {
    swapped.count(good, eyes_swapped(good));
  }
  for (const Caught& caught : {hidden, shifted, dim, digit, mirror, swapped}) {
    EXPECT_EQ(caught.noticed, caught.all);
  }
  std::string row = "| `" + golden_.name + "` |";
  for (const Caught& caught : {hidden, shifted, digit, dim, mirror, swapped}) {
    row += " " + caught.cell() + " |";
  }
  EXPECT_EQ(line_of_table(golden_.name), row) << "docs/golden-images.md is stale";
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

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const GoldenScene& scene : golden_scenes()) {
    names.push_back(scene.name);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Golden, ::testing::ValuesIn(scene_names()),
                         [](const auto& param) { return param.param; });

/// All of them, but of the same holograms from nine places (three distances, three rolls of the
/// head) each distance and each roll once.
std::vector<std::string> scenes_with_controls() {
  const std::set<std::string> elsewhere = {
      "guidance_35cm_rolled_left", "guidance_35cm_rolled_right", "guidance_50cm_rolled_left",
      "guidance_50cm_upright",     "guidance_70cm_upright",      "guidance_70cm_rolled_right"};
  std::vector<std::string> names = scene_names();
  EXPECT_EQ(std::erase_if(names, [&](const auto& name) { return elsewhere.contains(name); }),
            elsewhere.size());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, GoldenControls, ::testing::ValuesIn(scenes_with_controls()),
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
  GoldenPainter painter(GoldenPainter::kPinnedDevice, true, validation.sink());
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
  GoldenPainter painter(GoldenPainter::kPinnedDevice, true, validation.sink());
  const auto a = painter.paint(first.back());
  const auto b = painter.paint(second.back());
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_EQ(a->additive, b->additive);
  EXPECT_EQ(a->labels, b->labels);
}

}  // namespace
}  // namespace orthonav::engine
