#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "render/scene.h"
#include "render/text/font.h"

namespace orthonav::render {

/// The next code point of UTF-8 text, taken off its front; nothing where the bytes are not valid
/// UTF-8 (overlong forms, surrogates and truncation included).
[[nodiscard]] std::optional<char32_t> take_code_point(std::string_view& text);
[[nodiscard]] bool is_utf8(std::string_view text);

/// One glyph of a laid-out line: cap heights, y up, the anchor of the item at the origin.
struct PlacedGlyph {
  float left = 0;
  float bottom = 0;
  float right = 0;
  float top = 0;
  const FontFileGlyph* glyph = nullptr;
  Colour colour;
};

/// Width of the line in cap heights.
[[nodiscard]] float line_width(const Font& font, const TextItem& item);

/// Appends the visible glyphs of the line, anchored by `align` and `offset_*`, baseline at 0.
void lay_out(const Font& font, const TextItem& item, std::vector<PlacedGlyph>& glyphs);

/// Appends the code points of the line that the font lacks, unless `missing` holds them already.
void find_missing(const Font& font, const TextItem& item, std::vector<char32_t>& missing);

/// Width of the outline that `TextItem::rim` asks for, cap heights.
inline constexpr float kRimWidth = 0.09f;

}  // namespace orthonav::render
