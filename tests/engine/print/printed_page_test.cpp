#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/print/drawn_sheet.h"

namespace orthonav::engine::print_test {
namespace {

using ::testing::HasSubstr;

// A ruler's tick is 1.5 pixels wide: its centre of mass is exact but for the grey levels.
constexpr double kRulerToleranceMm = 0.02;

/// Centres of the dark runs along a line of the image, px.
std::vector<double> dark_centres(const std::vector<std::uint8_t>& line) {
  std::vector<double> centres;
  double mass = 0.0;
  double moment = 0.0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    const double dark = i < line.size() ? 255.0 - line[i] : 0.0;
    if (dark > 0) {
      mass += dark;
      moment += dark * (static_cast<double>(i) + 0.5);
    } else if (mass > 0) {
      centres.push_back(moment / mass);
      mass = moment = 0.0;
    }
  }
  return centres;
}

/// Length of the ruler along the page's width and of the other, over all their 101 ticks.
std::pair<double, double> rulers_mm(const Page& page, double px_per_mm) {
  const GreyImage image = drawn(blank_sheet(page), px_per_mm);
  const SheetRect across = horizontal_ruler(page);
  const SheetRect upward = vertical_ruler(page);
  const auto px = [](double mm) { return static_cast<int>(std::lround(mm * kPxPerMm)); };
  std::vector<std::uint8_t> row;
  for (int x = px(across.x_mm - 1); x < px(across.x_mm + across.width_mm + 1); ++x) {
    row.push_back(image.at(x, px(across.y_mm + 1)));
  }
  std::vector<std::uint8_t> column;
  for (int y = px(upward.y_mm - 1); y < px(upward.y_mm + upward.height_mm + 1); ++y) {
    column.push_back(image.at(px(upward.x_mm + upward.width_mm - 1), y));
  }
  const auto length_mm = [](const std::vector<double>& ticks) {
    EXPECT_EQ(ticks.size(), 101u);
    return ticks.empty() ? 0.0 : (ticks.back() - ticks.front()) / kPxPerMm;
  };
  return {length_mm(dark_centres(row)), length_mm(dark_centres(column))};
}

TEST(PrintedPage, HasRulersOf100Mm) {
  for (const PageSize& size : kPageSizes) {
    for (const bool landscape : {false, true}) {
      const auto page = page_named(std::string(size.name), landscape);
      ASSERT_TRUE(page);
      const auto [across, upward] = rulers_mm(*page, kPxPerMm);
      EXPECT_NEAR(across, 100.0, kRulerToleranceMm) << page->name;
      EXPECT_NEAR(upward, 100.0, kRulerToleranceMm) << page->name;
    }
  }
}

TEST(PrintedPage, RulersTellAPrintThatIsTooSmall) {
  const auto [across, upward] = rulers_mm(a4(), 0.999 * kPxPerMm);
  EXPECT_NEAR(across, 99.9, kRulerToleranceMm);
  EXPECT_NEAR(upward, 99.9, kRulerToleranceMm);
}

TEST(PrintedPdf, IsTheSameEachTime) {
  const auto sheets = tag_sheets({tag("tag36h11", 3, 0.040, "pointer")}, {a4(), 1.0});
  ASSERT_TRUE(sheets);
  const auto once = pdf_of(sheets->sheets, "orthonav tags");
  const auto again = pdf_of(sheets->sheets, "orthonav tags");
  ASSERT_TRUE(once && again);
  EXPECT_EQ(*once, *again);
  EXPECT_EQ(once->substr(0, 5), "%PDF-");
  EXPECT_THAT(*once, HasSubstr("20000101000000Z"));
  EXPECT_FALSE(pdf_of({}, "nothing"));
}

}  // namespace
}  // namespace orthonav::engine::print_test
