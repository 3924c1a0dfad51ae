#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/engine/print/drawn_sheet.h"

namespace orthonav::engine::print_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(PrintedTags, LieAndMeasureWhatTheLayoutSays) {
  for (const std::string family : {"tag36h11", "tagStandard41h12", "tag25h9", "tag36h10"}) {
    std::vector<PrintedTag> tags;
    for (int id = 0; id < 4; ++id) {
      tags.push_back(tag(family, id, 0.030));
    }
    tags.push_back(tag(family, 7, 0.0475, "pointer"));
    const auto sheets = tag_sheets(tags, {a4(), 1.0});
    ASSERT_TRUE(sheets) << sheets.error().message;
    std::vector<std::map<int, Corners>> pages;
    std::size_t count = 0;
    for (const Sheet& sheet : sheets->sheets) {
      pages.push_back(detected(drawn(sheet), family));
      count += pages.back().size();
    }
    ASSERT_EQ(count, tags.size()) << family;
    for (std::size_t i = 0; i < tags.size(); ++i) {
      const PlacedTag& at = sheets->placed[i];
      EXPECT_DOUBLE_EQ(at.size_mm, tags[i].marker.size_m * 1e3);
      const Corners expected =
          square(at.x_mm - at.size_mm / 2, at.y_mm - at.size_mm / 2, at.size_mm);
      EXPECT_LT(farthest_mm(pages[at.sheet].at(tags[i].marker.id), expected), kPlaceToleranceMm)
          << family;
    }
  }
}

TEST(PrintedTags, ATagPrintedTooSmallIsSeen) {
  const auto sheets = tag_sheets({tag("tag36h11", 3, 0.040)}, {a4(), 1.0});
  ASSERT_TRUE(sheets);
  const PlacedTag& at = sheets->placed[0];
  const Corners expected = square(at.x_mm - 20, at.y_mm - 20, 40);
  // "Fit to page" takes half a per cent: 0.2 mm of this tag.
  const auto found = detected(drawn(sheets->sheets[0], 0.995 * kPxPerMm), "tag36h11");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_GT(farthest_mm(found.at(3), expected), kPlaceToleranceMm);
}

TEST(PrintedTags, HaveWideBordersWhereTheirFamilySaysSo) {
  const auto sheets = tag_sheets({tag("tag36h11b2", 3, 0.040)}, {a4(), 1.0});
  ASSERT_TRUE(sheets) << sheets.error().message;
  const PlacedTag& at = sheets->placed[0];
  const Corners expected = square(at.x_mm - 20, at.y_mm - 20, 40);
  const GreyImage image = drawn(sheets->sheets[0]);
  for (const auto& found : {detected_with_wide_borders(image), detected(image, "tag36h11b2")}) {
    ASSERT_TRUE(found.contains(3));
    EXPECT_LT(farthest_mm(found.at(3), expected), kPlaceToleranceMm);
  }
}

TEST(PrintedTags, GoOnToFurtherPages) {
  std::vector<PrintedTag> tags;
  for (int id = 0; id < 20; ++id) {
    tags.push_back(tag("tag36h11", id, 0.038));
  }
  const auto sheets = tag_sheets(tags, {a4(), 2.0});
  ASSERT_TRUE(sheets);
  // Three columns and three rows of 57 mm and text on a page.
  ASSERT_EQ(sheets->sheets.size(), 3u);
  std::size_t found = 0;
  for (const Sheet& sheet : sheets->sheets) {
    found += detected(drawn(sheet), "tag36h11").size();
  }
  EXPECT_EQ(found, 20u);
  EXPECT_EQ(sheets->placed.back().sheet, 2u);
}

TEST(PrintedTags, RefuseWhatDoesNotFitOrDoesNotExist) {
  const auto refusal = [](const PrintedTag& tag, double quiet_cells = 1.0) {
    const auto sheets = tag_sheets({tag}, {a4(), quiet_cells});
    return sheets ? std::string() : sheets.error().message;
  };
  EXPECT_THAT(refusal(tag("tag36h11", 3, 0.145)), IsEmpty());
  EXPECT_THAT(refusal(tag("tag36h11", 3, 0.146)),
              HasSubstr("tag36h11 id 3 of 146 mm takes 182.5 mm with its quiet zone, page A4 has "
                        "room for 182 mm"));
  EXPECT_THAT(refusal(tag("tag36h11", 587, 0.04)), HasSubstr("587"));
  EXPECT_THAT(refusal(tag("tag36h9", 3, 0.04)), HasSubstr("unknown tag family 'tag36h9'"));
  EXPECT_THAT(refusal(tag("tag36h11", 3, 0.001)), HasSubstr("size 1 mm, must be 5-200 mm"));
  EXPECT_THAT(refusal(tag("tag36h11", 3, std::nan(""))), HasSubstr("must be 5-200 mm"));
  EXPECT_THAT(refusal(tag("tag36h11", 3, 0.04), 0.5), HasSubstr("must be 1-4"));
  EXPECT_FALSE(tag_sheets({}, {a4(), 1.0}));
  EXPECT_FALSE(page_named("A5", false));
}

}  // namespace
}  // namespace orthonav::engine::print_test
