#include "render/text/font.h"

#include <algorithm>
#include <cstring>

#include "base/check.h"
#include "embedded/font_atlas.h"

namespace orthonav::render {
namespace {

constexpr char32_t kMissing = U'□';

}  // namespace

Font::Font() {
  const std::string_view file = embedded::font_atlas();
  ORTHONAV_CHECK(file.size() > sizeof(header_));
  std::memcpy(&header_, file.data(), sizeof(header_));
  const std::size_t glyph_bytes = header_.glyphs * sizeof(FontFileGlyph);
  const std::size_t texels = std::size_t{header_.width_px} * header_.height_px;
  ORTHONAV_CHECK(file.size() == sizeof(header_) + glyph_bytes + texels);
  glyphs_.resize(header_.glyphs);
  std::memcpy(glyphs_.data(), file.data() + sizeof(header_), glyph_bytes);
  atlas_.resize(texels);
  std::memcpy(atlas_.data(), file.data() + sizeof(header_) + glyph_bytes, texels);
}

const FontFileGlyph* Font::find(char32_t code) const {
  const auto found = std::lower_bound(
      glyphs_.begin(), glyphs_.end(), static_cast<std::uint32_t>(code),
      [](const FontFileGlyph& glyph, std::uint32_t wanted) { return glyph.code < wanted; });
  return found != glyphs_.end() && found->code == static_cast<std::uint32_t>(code) ? &*found
                                                                                   : nullptr;
}

bool Font::has(char32_t code) const { return find(code) != nullptr; }

const FontFileGlyph& Font::glyph(char32_t code) const {
  const FontFileGlyph* found = find(code);
  if (found == nullptr) {
    found = find(kMissing);
  }
  return found != nullptr ? *found : glyphs_.front();
}

}  // namespace orthonav::render
