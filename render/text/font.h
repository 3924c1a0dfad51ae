#pragma once

#include <cstdint>
#include <vector>

#include "render/text/font_file.h"

namespace orthonav::render {

/// Signed-distance glyphs of the one embedded font (DejaVu Sans). Lengths in cap heights.
class Font {
 public:
  Font();
  /// The glyph of a code point; a hollow box for one that the font lacks.
  [[nodiscard]] const FontFileGlyph& glyph(char32_t code) const;
  [[nodiscard]] bool has(char32_t code) const;
  [[nodiscard]] const FontFileHeader& header() const { return header_; }
  /// width × height distances: 127.5 on the outline, larger inside.
  [[nodiscard]] const std::vector<std::uint8_t>& atlas() const { return atlas_; }

 private:
  [[nodiscard]] const FontFileGlyph* find(char32_t code) const;
  FontFileHeader header_;
  std::vector<FontFileGlyph> glyphs_;
  std::vector<std::uint8_t> atlas_;
};

}  // namespace orthonav::render
