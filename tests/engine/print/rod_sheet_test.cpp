#include "engine/print/rod_sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/angle.h"
#include "engine/print/sheet_drawing.h"

namespace orthonav::engine::rod_sheet_test {
namespace {

using ::testing::HasSubstr;

// Lines are placed in exact millimetres; the numbers are rounded to a tenth.
constexpr double kDrawnMm = 1e-9;

nav::RodInstructions told_through(int heads) {
  std::vector<Vec3> seats;
  for (int i = 0; i < heads; ++i) {
    const double a = 10.0 * kRadiansPerDegree * i;
    seats.push_back({0.0012 * (i % 2), -0.206 * std::cos(a), 0.206 * std::sin(a)});
  }
  return nav::rod_instructions(seats, {}).value();
}

bool says(const Sheet& sheet, const std::string& text) {
  return std::any_of(sheet.texts.begin(), sheet.texts.end(),
                     [&](const SheetText& t) { return t.text == text; });
}

TEST(RodSheet, SaysWhatToSetAndMarksTheBendsAtFullSize) {
  const Page page = page_named("A4", false).value();
  const auto told = told_through(5);
  const auto sheet = rod_sheet(told, {"left", "Ti-6Al-4V"}, page);
  ASSERT_TRUE(sheet.ok()) << sheet.error().message;
  const double left_mm = content_of(page).x_mm;
  for (const nav::RodInstruction& bend : told.bends) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f°", bend.set_rad * kDegreesPerRadian);
    EXPECT_TRUE(says(*sheet, text)) << text;
    const double at_mm = left_mm + bend.arc.centre_m * 1e3;
    EXPECT_TRUE(std::any_of(sheet->lines.begin(), sheet->lines.end(), [&](const SheetLine& line) {
      return std::abs(line.from_x_mm - at_mm) < kDrawnMm &&
             std::abs(line.to_x_mm - at_mm) < kDrawnMm && line.width_mm == 0.5;
    })) << at_mm;
  }
  // The rod's two ends are as far apart as it is cut.
  EXPECT_TRUE(std::any_of(sheet->lines.begin(), sheet->lines.end(), [&](const SheetLine& line) {
    return std::abs(line.to_x_mm - left_mm - told.cut_length_m() * 1e3) < kDrawnMm &&
           line.from_x_mm == line.to_x_mm;
  }));
  EXPECT_TRUE(pdf_of({&*sheet, 1}, "rod").ok());
}

TEST(RodSheet, FoldsALongRodIntoRows) {
  std::vector<Vec3> seats;
  for (int i = 0; i < 9; ++i) {
    seats.push_back({0, 0, 0.04 * i});
  }
  const auto told = nav::rod_instructions(seats, {}).value();
  const auto sheet = rod_sheet(told, {}, page_named("A4", false).value());
  ASSERT_TRUE(sheet.ok()) << sheet.error().message;
  EXPECT_TRUE(says(*sheet, "180.0 mm"));
  EXPECT_TRUE(says(*sheet, "330.0 mm"));
}

TEST(RodSheet, RefusesAPageThatIsTooSmall) {
  Page card;
  card.name = "card";
  card.width_mm = card.height_mm = 120.0;
  EXPECT_THAT(rod_sheet(told_through(4), {}, card).error().message,
              HasSubstr("page card has room for"));
}

}  // namespace
}  // namespace orthonav::engine::rod_sheet_test
