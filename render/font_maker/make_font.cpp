// make_font FONT.ttf OUT: writes the glyph atlas that render/text/font.h reads.
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_MODULE_H

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "render/text/font_file.h"

namespace orthonav::font_maker {
namespace {

using render::FontFileGlyph;
using render::FontFileHeader;

constexpr int kEm_px = 48;       // of the atlas
constexpr FT_Int kReach_px = 6;  // of the distances on either side of the outline
constexpr int kAtlasWidth_px = 1024;

constexpr char32_t kFigureDash = U'\u2012';

/// Latin with accents, and the signs a navigation display needs.
std::vector<char32_t> wanted() {
  std::vector<char32_t> codes;
  for (char32_t c = 0x20; c < 0x7f; ++c) {
    codes.push_back(c);
  }
  for (char32_t c = 0xa0; c < 0x180; ++c) {
    codes.push_back(c);
  }
  for (const char32_t c :
       U"ΔΘΣΩαβγδεθκλμπρσφω‐‑‒–—‘’“”•…′″←↑→↓↔↕−∞≈≠≤≥⌀□▲▶▼◀◆◇○◐●✓✗\u2007\u2009\u202f") {
    if (c != 0) {
      codes.push_back(c);
    }
  }
  std::sort(codes.begin(), codes.end());
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
  return codes;
}

struct Cell {
  FontFileGlyph glyph;
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> texels;
};

Cell cell_of(FT_Face face, char32_t code, float cap_px) {
  Cell cell;
  cell.glyph.code = static_cast<std::uint32_t>(code);
  const FT_GlyphSlot slot = face->glyph;
  cell.glyph.advance = static_cast<float>(slot->linearHoriAdvance) / 65536.0f / cap_px;
  const FT_Bitmap& bitmap = slot->bitmap;
  cell.width_px = static_cast<int>(bitmap.width);
  cell.height_px = static_cast<int>(bitmap.rows);
  for (int y = 0; y < cell.height_px; ++y) {
    const std::uint8_t* row = bitmap.buffer + y * bitmap.pitch;
    cell.texels.insert(cell.texels.end(), row, row + cell.width_px);
  }
  // Baseline origin, y up.
  cell.glyph.left = static_cast<float>(slot->bitmap_left) / cap_px;
  cell.glyph.bottom = static_cast<float>(slot->bitmap_top - cell.height_px) / cap_px;
  cell.glyph.right = static_cast<float>(slot->bitmap_left + cell.width_px) / cap_px;
  cell.glyph.top = static_cast<float>(slot->bitmap_top) / cap_px;
  return cell;
}

/// Packs the cells in rows, in their order, each row as tall as its tallest glyph; fills in the
/// texture rectangles.
std::vector<std::uint8_t> packed(std::vector<Cell>& cells, int& height_px) {
  int x = 0;
  int y = 0;
  int row_height = 0;
  for (Cell& cell : cells) {
    if (x + cell.width_px > kAtlasWidth_px) {
      x = 0;
      y += row_height;
      row_height = 0;
    }
    cell.glyph.u0 = static_cast<std::uint16_t>(x);
    cell.glyph.v0 = static_cast<std::uint16_t>(y);
    cell.glyph.u1 = static_cast<std::uint16_t>(x + cell.width_px);
    cell.glyph.v1 = static_cast<std::uint16_t>(y + cell.height_px);
    x += cell.width_px;
    row_height = std::max(row_height, cell.height_px);
  }
  height_px = y + row_height;
  std::vector<std::uint8_t> atlas(static_cast<std::size_t>(kAtlasWidth_px) * height_px);
  for (const Cell& cell : cells) {
    for (int row = 0; row < cell.height_px; ++row) {
      std::memcpy(
          &atlas[static_cast<std::size_t>(cell.glyph.v0 + row) * kAtlasWidth_px + cell.glyph.u0],
          &cell.texels[static_cast<std::size_t>(row) * cell.width_px], cell.width_px);
    }
  }
  return atlas;
}

/// A dash as wide as a digit would merge with its neighbours into one stroke. The figure dash is
/// therefore a hyphen, centred in that width.
void set_apart(std::vector<Cell>& cells) {
  const auto find = [&](char32_t code) {
    return std::find_if(cells.begin(), cells.end(),
                        [&](const Cell& cell) { return cell.glyph.code == code; });
  };
  const auto dash = find(kFigureDash);
  const auto hyphen = find(U'-');
  if (dash == cells.end() || hyphen == cells.end()) {
    return;
  }
  const float advance = dash->glyph.advance;
  const float offset = 0.5f * (advance - hyphen->glyph.advance);
  *dash = *hyphen;
  dash->glyph.code = static_cast<std::uint32_t>(kFigureDash);
  dash->glyph.advance = advance;
  dash->glyph.left += offset;
  dash->glyph.right += offset;
}

/// Header, glyphs and atlas. `reach`: how far distances reach beyond a glyph, in heights of an H.
bool write_font(const char* path, std::vector<Cell>& cells, float reach) {
  int height_px = 0;
  const std::vector<std::uint8_t> atlas = packed(cells, height_px);
  FontFileHeader header;
  header.glyphs = static_cast<std::uint32_t>(cells.size());
  header.width_px = kAtlasWidth_px;
  header.height_px = static_cast<std::uint32_t>(height_px);
  header.reach = reach;
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(&header), sizeof(header));
  for (const Cell& cell : cells) {
    out.write(reinterpret_cast<const char*>(&cell.glyph), sizeof(cell.glyph));
  }
  out.write(reinterpret_cast<const char*>(atlas.data()),
            static_cast<std::streamsize>(atlas.size()));
  out.close();
  return static_cast<bool>(out);
}

int fail(const char* what) {
  std::fprintf(stderr, "make_font: %s\n", what);
  return 2;
}

int make(const char* font_path, const char* out_path) {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  if (FT_Init_FreeType(&library) || FT_New_Face(library, font_path, 0, &face)) {
    return fail("the font can't be opened");
  }
  if (FT_Property_Set(library, "sdf", "spread", &kReach_px)) {
    return fail("FreeType has no distance fields");
  }
  FT_Set_Pixel_Sizes(face, 0, kEm_px);
  if (FT_Load_Char(face, U'H', FT_LOAD_NO_HINTING)) {
    return fail("the font has no H");
  }
  const float cap_px = static_cast<float>(face->glyph->metrics.horiBearingY) / 64.0f;
  std::vector<Cell> cells;
  for (const char32_t code : wanted()) {
    if (FT_Get_Char_Index(face, code) == 0) {
      continue;
    }
    if (FT_Load_Char(face, code, FT_LOAD_NO_HINTING) ||
        FT_Render_Glyph(face->glyph, FT_RENDER_MODE_SDF)) {
      return fail("a glyph can't be rendered");
    }
    cells.push_back(cell_of(face, code, cap_px));
  }
  set_apart(cells);
  const bool written = write_font(out_path, cells, static_cast<float>(kReach_px) / cap_px);
  FT_Done_Face(face);
  FT_Done_FreeType(library);
  return written ? 0 : fail("the output can't be written");
}

}  // namespace
}  // namespace orthonav::font_maker

int main(int argc, char** argv) {
  if (argc != 3) {
    return orthonav::font_maker::fail("usage: make_font FONT.ttf OUT");
  }
  return orthonav::font_maker::make(argv[1], argv[2]);
}
