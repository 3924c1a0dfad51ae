#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/print/drawn_sheet.h"

namespace orthonav::engine::print_test {
namespace {

using ::testing::HasSubstr;

struct Box {
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
};

Box box_of(const SheetCut& cut) {
  Box box;
  for (const Vec2& c : cut.corners_mm) {
    box = {std::min(box.left, c.x), std::min(box.top, c.y), std::max(box.right, c.x),
           std::max(box.bottom, c.y)};
  }
  return box;
}

TEST(PrintedTags, KeepTheirQuietZoneInsideTheCut) {
  for (const double quiet_cells : {1.0, 2.5}) {
    const auto sheets = tag_sheets({tag("tag36h11", 3, 0.040)}, {a4(), quiet_cells});
    ASSERT_TRUE(sheets);
    ASSERT_EQ(sheets->sheets[0].cuts.size(), 1u);
    const Box cut = box_of(sheets->sheets[0].cuts[0]);
    EXPECT_NEAR(cut.right - cut.left, 40 + 2 * 5 * quiet_cells, 1e-9);
    const PlacedTag& at = sheets->placed[0];
    EXPECT_GE(at.y_mm - 20 - cut.top, 5 * quiet_cells);
    EXPECT_GE(cut.bottom - at.y_mm - 20, 5 * quiet_cells);
    // The bits of this family reach two cells beyond its size of five.
    const auto outside = tag_sheets({tag("tagStandard41h12", 3, 0.040)}, {a4(), quiet_cells});
    ASSERT_TRUE(outside);
    const Box wide = box_of(outside->sheets[0].cuts[0]);
    EXPECT_NEAR(wide.right - wide.left, 40 + 2 * 8 * (2 + quiet_cells), 1e-9);
  }
}

/// By the rule of crossings: a ray to the right.
bool is_inside(const SheetCut& cut, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < cut.corners_mm.size(); ++i) {
    const Vec2 a = cut.corners_mm[i];
    const Vec2 b = cut.corners_mm[(i + 1) % cut.corners_mm.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
      inside = !inside;
    }
  }
  return inside;
}

/// As it is once cut out and glued onto something black.
GreyImage cut_out(const GreyImage& page, const SheetCut& cut) {
  GreyImage image = page;
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      if (!is_inside(cut, {(x + 0.5) / kPxPerMm, (y + 0.5) / kPxPerMm})) {
        image.at(x, y) = 0;
      }
    }
  }
  return image;
}

/// The darkest pixel of the quiet zone: `quiet_mm` of white around a square of `size_mm`.
int darkest_around(const GreyImage& image, const PlacedTag& at, double size_mm, double quiet_mm) {
  // The tag's own edge, and the cut line beside the quiet zone, cover half a pixel more.
  constexpr double kEdgeMm = 0.1;
  int darkest = 255;
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      const double off_mm = std::max(std::abs((x + 0.5) / kPxPerMm - at.x_mm),
                                     std::abs((y + 0.5) / kPxPerMm - at.y_mm)) -
                            size_mm / 2;
      if (off_mm > kEdgeMm && off_mm < quiet_mm - kEdgeMm) {
        darkest = std::min(darkest, static_cast<int>(image.at(x, y)));
      }
    }
  }
  return darkest;
}

struct CutTag {
  const char* family;
  double size_mm;
  double quiet_mm;  ///< a cell
  double outer_mm;  ///< with the bits outside of the border
};

constexpr CutTag kCutTags[] = {{"tag36h11", 40, 5, 40},       {"tag36h11", 12, 1.5, 12},
                               {"tag36h11", 5, 0.625, 5},     {"tagStandard41h12", 40, 8, 72},
                               {"tagStandard41h12", 5, 1, 9}, {"tag36h11", 120, 15, 120}};

TEST(PrintedTags, CarryIdSizeAndUpwardSideOnThePaperThatIsCutOut) {
  for (const CutTag& c : kCutTags) {
    const auto sheets = tag_sheets({tag(c.family, 17, c.size_mm * 1e-3, "pointer")}, {a4(), 1.0});
    ASSERT_TRUE(sheets) << sheets.error().message;
    const Sheet& sheet = sheets->sheets[0];
    const PlacedTag& at = sheets->placed[0];
    std::string inside;
    for (const SheetText& text : sheet.texts) {
      if (!is_inside(sheet.cuts[0], {text.x_mm, text.y_mm})) {
        continue;
      }
      inside += text.text + "|";
      EXPECT_GE(text.height_mm, 1.2) << "legible";
      EXPECT_GT(std::abs(text.y_mm - text.height_mm / 2 - at.y_mm), c.outer_mm / 2 + c.quiet_mm)
          << text.text;
      if (text.text == "up") {
        EXPECT_LT(text.y_mm, at.y_mm) << "above the tag";
      }
    }
    EXPECT_THAT(inside, HasSubstr("id 17"));
    EXPECT_THAT(inside, HasSubstr(mm_text(c.size_mm) + " mm"));
    EXPECT_THAT(inside, HasSubstr("up|"));
    EXPECT_THAT(inside, HasSubstr(c.family));
    // The notch: in the middle of the upper edge, and in no other.
    const Box cut = box_of(sheet.cuts[0]);
    EXPECT_FALSE(is_inside(sheet.cuts[0], {at.x_mm, cut.top + 0.5}));
    EXPECT_TRUE(is_inside(sheet.cuts[0], {at.x_mm, cut.bottom - 0.1}));
    EXPECT_TRUE(is_inside(sheet.cuts[0], {cut.left + 0.1, at.y_mm}));
    EXPECT_TRUE(is_inside(sheet.cuts[0], {cut.right - 0.1, at.y_mm}));
  }
}

TEST(PrintedTags, AreFoundWhenCutOutWithTheirText) {
  for (const CutTag& c : kCutTags) {
    const auto sheets = tag_sheets({tag(c.family, 17, c.size_mm * 1e-3)}, {a4(), 1.0});
    ASSERT_TRUE(sheets) << sheets.error().message;
    const PlacedTag& at = sheets->placed[0];
    const GreyImage page = drawn(sheets->sheets[0]);
    EXPECT_EQ(darkest_around(page, at, c.outer_mm, c.quiet_mm), 255)
        << c.family << " " << c.size_mm;
    const auto found = detected(cut_out(page, sheets->sheets[0].cuts[0]), c.family);
    ASSERT_TRUE(found.contains(17)) << c.family << " " << c.size_mm;
    EXPECT_EQ(found.size(), 1u);
    const Corners expected = square(at.x_mm - c.size_mm / 2, at.y_mm - c.size_mm / 2, c.size_mm);
    EXPECT_LT(farthest_mm(found.at(17), expected), kPlaceToleranceMm) << c.family << c.size_mm;
  }
}

}  // namespace
}  // namespace orthonav::engine::print_test
