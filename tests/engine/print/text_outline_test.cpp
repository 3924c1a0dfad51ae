#include "engine/print/text_outline.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace orthonav::engine {
namespace {

struct Extent {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
};

Extent extent_of(const TextOutline& outline) {
  Extent e;
  for (const TextOutline::Step& step : outline.steps) {
    const Vec2 end = step.kind == TextOutline::Kind::kCubic ? step.to[2] : step.to[0];
    e = {std::min(e.left, end.x), std::max(e.right, end.x), std::min(e.top, end.y),
         std::max(e.bottom, end.y)};
  }
  return e;
}

TEST(TextOutline, StandsOnItsBaseline) {
  const auto font = PrintFont::open();
  ASSERT_TRUE(font) << font.error().message;
  // DejaVu Sans: capitals are 1493 of 2048 units high, an H stands on the line.
  const Extent h = extent_of(font->outline("H"));
  EXPECT_NEAR(h.bottom, 0.0, 1e-9);
  EXPECT_NEAR(h.top, -1493.0 / 2048.0, 1e-9);
  EXPECT_GT(extent_of(font->outline("g")).bottom, 0.1);
}

TEST(TextOutline, GoesOnToTheRight) {
  const auto font = PrintFont::open();
  ASSERT_TRUE(font);
  const double one = font->outline("1").advance;
  EXPECT_NEAR(font->outline("111").advance, 3 * one, 1e-12);
  EXPECT_GT(extent_of(font->outline("11")).left, 0.0);
  EXPECT_LT(extent_of(font->outline("11")).right, 2 * one);
  EXPECT_TRUE(font->outline("").steps.empty());
  EXPECT_TRUE(font->outline(" ").steps.empty());
  EXPECT_GT(font->outline(" ").advance, 0.0);
}

TEST(TextOutline, TakesUtf8AndDrawsABoxForWhatIsNone) {
  const auto font = PrintFont::open();
  ASSERT_TRUE(font);
  // Each one letter of the font.
  for (const char* letter : {"\xC3\xA4", "\xC2\xB5", "\xE2\x82\xAC"}) {
    EXPECT_FALSE(font->outline(letter).steps.empty()) << letter;
  }
  const auto box = font->outline("\xFF");
  EXPECT_FALSE(box.steps.empty());
  // Cut off, or too long: a box, then the rest.
  EXPECT_EQ(font->outline("\xC3").steps.size(), box.steps.size());
  EXPECT_EQ(font->outline("\xE2\x82").steps.size(), box.steps.size());
  EXPECT_NEAR(font->outline("\xC3H").advance, box.advance + font->outline("H").advance, 1e-12);
}

}  // namespace
}  // namespace orthonav::engine
