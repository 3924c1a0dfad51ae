#include "render/text/text_layout.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/frame/frame_items.h"

namespace orthonav::render {
namespace {

TextItem line(const std::string& text, TextAlign align = TextAlign::kLeft) {
  TextItem item;
  item.runs = {{text, Colour{}}};
  item.align = align;
  return item;
}

TEST(TextLayout, GivesEveryDigitTheSameWidth) {
  const Font font;
  const float zero = font.glyph(U'0').advance;
  for (char32_t digit = U'1'; digit <= U'9'; ++digit) {
    EXPECT_FLOAT_EQ(font.glyph(digit).advance, zero);
  }
  EXPECT_NE(font.glyph(U'i').advance, zero) << "the twin: letters differ";
}

TEST(TextLayout, KeepsTheWidthOfANumberThatIsLostOrShort) {
  const Font font;
  const float width = line_width(font, line("12.4°"));
  EXPECT_FLOAT_EQ(line_width(font, line("88.8°")), width);
  EXPECT_FLOAT_EQ(line_width(font, line("\u20079.5°")), width);
  EXPECT_FLOAT_EQ(line_width(font, line("\u2012\u2012.\u2012°")), width);
  EXPECT_NE(line_width(font, line("--.-°")), width) << "the twin: hyphens are narrower";
}

TEST(TextLayout, HasEverySignOfADisplay) {
  const Font font;
  std::string_view signs = "0123456789 °−–●○◐·…✓%()/:,|<>±≤≥µäöüßéÅ→";
  while (const auto code = take_code_point(signs)) {
    EXPECT_TRUE(font.has(*code)) << "U+" << std::hex << static_cast<unsigned>(*code);
  }
  ASSERT_TRUE(font.has(U'□'));
  EXPECT_FALSE(font.has(U'漢'));
  EXPECT_EQ(font.glyph(U'漢').code, U'□');
}

TEST(TextLayout, MeasuresInCapHeights) {
  const Font font;
  const FontFileGlyph& h = font.glyph(U'H');
  const float reach = font.header().reach;
  // The rectangle carries the reach of the distances around the letter, up to a texel more.
  EXPECT_NEAR(h.bottom, -reach, 0.03f);
  EXPECT_NEAR(h.top, 1 + reach, 0.03f);
}

TEST(TextLayout, AnchorsWhereItIsTold) {
  const Font font;
  const float width = line_width(font, line("L4 left"));
  std::vector<PlacedGlyph> left;
  std::vector<PlacedGlyph> centre;
  std::vector<PlacedGlyph> right;
  lay_out(font, line("L4 left", TextAlign::kLeft), left);
  lay_out(font, line("L4 left", TextAlign::kCentre), centre);
  lay_out(font, line("L4 left", TextAlign::kRight), right);
  ASSERT_EQ(left.size(), 6u);  // the blank is not drawn
  EXPECT_NEAR(left[0].left - centre[0].left, 0.5f * width, 1e-5f);
  EXPECT_NEAR(left[0].left - right[0].left, width, 1e-5f);
}

TEST(TextLayout, ShiftsInCapHeights) {
  const Font font;
  TextItem item = line("x");
  std::vector<PlacedGlyph> plain;
  lay_out(font, item, plain);
  item.offset_right = 1.5f;
  item.offset_up = -0.5f;
  std::vector<PlacedGlyph> shifted;
  lay_out(font, item, shifted);
  EXPECT_NEAR(shifted[0].left - plain[0].left, 1.5f, 1e-5f);
  EXPECT_NEAR(shifted[0].bottom - plain[0].bottom, -0.5f, 1e-5f);
}

TEST(Utf8, TakesCodePointsOneByOne) {
  std::string_view text = "a°●𝄞";
  EXPECT_EQ(take_code_point(text), U'a');
  EXPECT_EQ(take_code_point(text), U'°');
  EXPECT_EQ(take_code_point(text), U'●');
  EXPECT_EQ(take_code_point(text), U'𝄞');
  EXPECT_FALSE(take_code_point(text));
}

TEST(Utf8, RefusesWhatIsNone) {
  EXPECT_TRUE(is_utf8("12.4°"));
  EXPECT_FALSE(is_utf8("\xc2"));              // cut short
  EXPECT_FALSE(is_utf8("\xb0"));              // Latin-1 degree sign
  EXPECT_FALSE(is_utf8("\xc0\xaf"));          // overlong
  EXPECT_FALSE(is_utf8("\xed\xa0\x80"));      // surrogate
  EXPECT_FALSE(is_utf8("\xf4\x90\x80\x80"));  // beyond Unicode
  EXPECT_FALSE(is_utf8("\xff"));
}

TEST(TextPlacement, IsNeverSmallerThanItsVisualAngle) {
  TextItem item = line("12.4°");
  item.position = {0, 0, -2};
  item.height_m = 0.001f;
  item.min_height_deg = 0.8f;
  const Head head;
  const Matrix4 far = world_from_caps(item, head);
  EXPECT_NEAR(far[1].y, 2 * 2 * std::tan(0.4f * 0.01745329f), 1e-5f);
  item.position = {0, 0, -0.05f};
  EXPECT_FLOAT_EQ(world_from_caps(item, head)[1].y, 0.001f) << "the twin: near, its own height";
}

TEST(TextPlacement, StandsUprightToATiltedHead) {
  TextItem item = line("12.4°");
  item.position = {0.1f, 0, -0.5f};
  item.height_m = 0.01f;
  Head head;
  head.right = {0, 1, 0};  // lying on the side
  head.up = {-1, 0, 0};
  const Matrix4 place = world_from_caps(item, head);
  EXPECT_NEAR(place[0].y, 0.01f, 1e-4f) << "its right is the head's right";
  EXPECT_LT(place[1].x, -0.009f) << "its up is the head's up";
}

}  // namespace
}  // namespace orthonav::render
