#include "render/text/text_layout.h"

#include <algorithm>

namespace orthonav::render {
namespace {

/// Glyphs with a rim are set a little farther apart, so that rims do not overlap between them.
float extra_advance(const TextItem& item) { return item.rim.a > 0 ? kRimWidth : 0.0f; }

float anchor(const TextItem& item, float width) {
  switch (item.align) {
    case TextAlign::kLeft:
      return 0;
    case TextAlign::kCentre:
      return -0.5f * width;
    case TextAlign::kRight:
      break;
  }
  return -width;
}

struct Lead {
  int more = 0;
  char32_t bits = 0;
  char32_t least = 0;  ///< a smaller code point in this form is overlong
};

std::optional<Lead> lead_of(unsigned char byte) {
  if (byte < 0x80) {
    return Lead{0, byte, 0};
  }
  if ((byte & 0xe0) == 0xc0) {
    return Lead{1, byte & 0x1fu, 0x80};
  }
  if ((byte & 0xf0) == 0xe0) {
    return Lead{2, byte & 0x0fu, 0x800};
  }
  if ((byte & 0xf8) == 0xf0) {
    return Lead{3, byte & 0x07u, 0x10000};
  }
  return std::nullopt;
}

}  // namespace

std::optional<char32_t> take_code_point(std::string_view& text) {
  if (text.empty()) {
    return std::nullopt;
  }
  const std::optional<Lead> lead = lead_of(static_cast<unsigned char>(text.front()));
  if (!lead || text.size() < static_cast<std::size_t>(lead->more) + 1) {
    return std::nullopt;
  }
  char32_t code = lead->bits;
  for (int i = 1; i <= lead->more; ++i) {
    const auto byte = static_cast<unsigned char>(text[static_cast<std::size_t>(i)]);
    if ((byte & 0xc0) != 0x80) {
      return std::nullopt;
    }
    code = code << 6 | (byte & 0x3fu);
  }
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  if (code < lead->least || surrogate || code > 0x10ffff) {
    return std::nullopt;
  }
  text.remove_prefix(static_cast<std::size_t>(lead->more) + 1);
  return code;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    if (!take_code_point(text)) {
      return false;
    }
  }
  return true;
}

float line_width(const Font& font, const TextItem& item) {
  float width = 0;
  int count = 0;
  for (const TextRun& run : item.runs) {
    std::string_view rest = run.text;
    while (const auto code = take_code_point(rest)) {
      width += font.glyph(*code).advance;
      ++count;
    }
  }
  return count == 0 ? 0 : width + static_cast<float>(count - 1) * extra_advance(item);
}

void lay_out(const Font& font, const TextItem& item, std::vector<PlacedGlyph>& glyphs) {
  float pen = anchor(item, line_width(font, item)) + item.offset_right;
  for (const TextRun& run : item.runs) {
    std::string_view rest = run.text;
    while (const auto code = take_code_point(rest)) {
      const FontFileGlyph& glyph = font.glyph(*code);
      if (glyph.u1 > glyph.u0) {
        glyphs.push_back({pen + glyph.left, item.offset_up + glyph.bottom, pen + glyph.right,
                          item.offset_up + glyph.top, &glyph, run.colour});
      }
      pen += glyph.advance + extra_advance(item);
    }
  }
}

void find_missing(const Font& font, const TextItem& item, std::vector<char32_t>& missing) {
  for (const TextRun& run : item.runs) {
    std::string_view rest = run.text;
    while (const auto code = take_code_point(rest)) {
      const bool known =
          font.has(*code) || std::find(missing.begin(), missing.end(), *code) != missing.end();
      if (!known) {
        missing.push_back(*code);
      }
    }
  }
}

}  // namespace orthonav::render
