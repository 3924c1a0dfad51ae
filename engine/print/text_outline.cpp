#include "engine/print/text_outline.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <cstdint>
#include <string>

#include "embedded/print_font.h"

namespace orthonav::engine {

struct PrintFont::Library {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  ~Library() {
    if (face != nullptr) {
      FT_Done_Face(face);
    }
    if (library != nullptr) {
      FT_Done_FreeType(library);
    }
  }
};

namespace {

/// A character that the font lacks.
constexpr char32_t kUnknown = 0xFFFFFFFF;

/// The letter that begins at `at`, which advances to the next; `kUnknown` if it is not valid UTF-8.
char32_t next_letter(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(at++);
  if (first < 0x80) {
    return first;
  }
  const int more = first >= 0xF0 && first < 0xF8   ? 3
                   : first >= 0xE0 && first < 0xF0 ? 2
                   : first >= 0xC2 && first < 0xE0 ? 1
                                                   : 0;
  if (more == 0) {
    return kUnknown;
  }
  char32_t letter = first & (0x3Fu >> more);
  for (int i = 0; i < more; ++i) {
    if (at >= text.size() || (byte(at) & 0xC0u) != 0x80u) {
      return kUnknown;
    }
    letter = letter << 6u | (byte(at++) & 0x3Fu);
  }
  return letter;
}

/// Takes one glyph's outline from font units (y up) to the text's.
struct Pen {
  TextOutline& out;
  double units;  ///< a height
  Vec2 last{};

  [[nodiscard]] Vec2 placed(const FT_Vector& v) const {
    return {out.advance + static_cast<double>(v.x) / units, -static_cast<double>(v.y) / units};
  }
};

int move_to(const FT_Vector* to, void* user) {
  Pen& pen = *static_cast<Pen*>(user);
  pen.last = pen.placed(*to);
  pen.out.steps.push_back({TextOutline::Kind::kMove, {pen.last}});
  return 0;
}

int line_to(const FT_Vector* to, void* user) {
  Pen& pen = *static_cast<Pen*>(user);
  pen.last = pen.placed(*to);
  pen.out.steps.push_back({TextOutline::Kind::kLine, {pen.last}});
  return 0;
}

int conic_to(const FT_Vector* control, const FT_Vector* to, void* user) {
  Pen& pen = *static_cast<Pen*>(user);
  const Vec2 c = pen.placed(*control);
  const Vec2 end = pen.placed(*to);
  // The same parabola as a cubic.
  const Vec2 first = pen.last + (2.0 / 3.0) * (c - pen.last);
  const Vec2 second = end + (2.0 / 3.0) * (c - end);
  pen.out.steps.push_back({TextOutline::Kind::kCubic, {first, second, end}});
  pen.last = end;
  return 0;
}

int cubic_to(const FT_Vector* a, const FT_Vector* b, const FT_Vector* to, void* user) {
  Pen& pen = *static_cast<Pen*>(user);
  pen.last = pen.placed(*to);
  pen.out.steps.push_back({TextOutline::Kind::kCubic, {pen.placed(*a), pen.placed(*b), pen.last}});
  return 0;
}

}  // namespace

PrintFont::PrintFont(std::unique_ptr<Library> library) : library_(std::move(library)) {}
PrintFont::PrintFont(PrintFont&&) noexcept = default;
PrintFont& PrintFont::operator=(PrintFont&&) noexcept = default;
PrintFont::~PrintFont() = default;

Result<PrintFont> PrintFont::open() {
  auto library = std::make_unique<Library>();
  const std::string_view bytes = embedded::print_font();
  FT_Error error = FT_Init_FreeType(&library->library);
  if (error == 0) {
    error = FT_New_Memory_Face(library->library, reinterpret_cast<const FT_Byte*>(bytes.data()),
                               static_cast<FT_Long>(bytes.size()), 0, &library->face);
  }
  if (error != 0) {
    return Error{"the embedded font cannot be read (FreeType error " + std::to_string(error) + ")"};
  }
  return PrintFont(std::move(library));
}

TextOutline PrintFont::outline(std::string_view text) const {
  constexpr FT_Outline_Funcs kDraw = {move_to, line_to, conic_to, cubic_to, 0, 0};
  const FT_Face face = library_->face;
  TextOutline out;
  Pen pen{out, static_cast<double>(face->units_per_EM)};
  for (std::size_t at = 0; at < text.size();) {
    const FT_UInt glyph = FT_Get_Char_Index(face, next_letter(text, at));
    if (FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE) != 0) {
      continue;
    }
    FT_Outline_Decompose(&face->glyph->outline, &kDraw, &pen);
    out.advance += static_cast<double>(face->glyph->metrics.horiAdvance) / pen.units;
  }
  return out;
}

}  // namespace orthonav::engine
