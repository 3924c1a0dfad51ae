#include "engine/print/tag_patch.h"

#include <algorithm>
#include <utility>

namespace orthonav::engine {
namespace {

constexpr double kSmallestMm = 5.0;
constexpr double kLargestMm = 200.0;
constexpr double kCaptionMm = 2.4;
constexpr double kCaptionPitchMm = 3.2;
// Room for the captions under a small tag.
constexpr double kLeastWidthMm = 34.0;

// Text inside the cut: as large as the paper allows, in one row if that stays easy to read, and
// never too small to print and read.
constexpr double kLargestTextMm = 2.4;
constexpr double kOneRowTextMm = 1.6;
constexpr double kSmallestTextMm = 1.2;
constexpr double kTextMarginMm = 0.4;

// In heights of the font; the strip above the quiet zone is 1.5 high.
constexpr double kNotchDepth = 1.2;
constexpr double kNotchHalfWidth = 0.8;
constexpr const char* kArrow = "\xE2\x96\xB2";

/// The height at which the longest row fills the paper.
double filling_mm(const std::vector<std::string>& rows, double width_mm, const PrintFont& font) {
  double longest = 0.0;
  for (const std::string& row : rows) {
    longest = std::max(longest, font.outline(row).advance);
  }
  return (width_mm - 2 * kTextMarginMm) / longest;
}

void label(TagPatch& patch, const PrintedTag& tag, const PrintFont& font) {
  const std::string which = "id " + std::to_string(tag.marker.id);
  const std::string size = mm_text(patch.size_mm) + " mm";
  const double paper_mm = patch.quiet_mm();
  patch.rows = {tag.marker.family + "  " + which + "  " + size};
  if (filling_mm(patch.rows, paper_mm, font) < kOneRowTextMm) {
    patch.rows = {which, size, tag.marker.family};
  }
  const double filling = filling_mm(patch.rows, paper_mm, font);
  patch.text_mm = std::clamp(filling, kSmallestTextMm, kLargestTextMm);
  // A long family's name on a tiny tag takes more paper than the tag.
  patch.cut_width_mm = std::max(
      paper_mm, (paper_mm - 2 * kTextMarginMm) * patch.text_mm / filling + 2 * kTextMarginMm);
}

SheetCut cut_of(const TagPatch& patch, double left_mm, double top_mm) {
  const double right_mm = left_mm + patch.cut_width_mm;
  const double bottom_mm = top_mm + patch.cut_height_mm();
  const double middle_mm = (left_mm + right_mm) / 2;
  const double notch_mm = kNotchHalfWidth * patch.text_mm;
  return {{{left_mm, top_mm},
           {middle_mm - notch_mm, top_mm},
           {middle_mm, top_mm + kNotchDepth * patch.text_mm},
           {middle_mm + notch_mm, top_mm},
           {right_mm, top_mm},
           {right_mm, bottom_mm},
           {left_mm, bottom_mm}}};
}

/// The arrow and the word on either side of the notch.
void add_up_mark(Sheet& sheet, const TagPatch& patch, double middle_mm, double top_mm) {
  const double apart_mm = (kNotchHalfWidth + 0.2) * patch.text_mm;
  const double baseline_mm = top_mm + 1.1 * patch.text_mm;
  sheet.texts.push_back(
      {middle_mm - apart_mm, baseline_mm, patch.text_mm, kArrow, SheetAlign::kRight});
  sheet.texts.push_back(
      {middle_mm + apart_mm, baseline_mm, patch.text_mm, "up", SheetAlign::kLeft});
}

}  // namespace

double TagPatch::width_mm() const { return std::max(cut_width_mm, kLeastWidthMm); }

double TagPatch::height_mm() const {
  return cut_height_mm() + kCaptionPitchMm * static_cast<double>(captions.size()) + 1.0;
}

Result<TagPatch> tag_patch(const PrintedTag& tag, double quiet_cells, const PrintFont& font) {
  auto cells = tag_cells(tag.marker.family, tag.marker.id);
  if (!cells) {
    return cells.error();
  }
  TagPatch patch;
  patch.size_mm = tag.marker.size_m * 1e3;
  if (!(patch.size_mm >= kSmallestMm && patch.size_mm <= kLargestMm)) {
    return Error{"tag " + tag.marker.family + " id " + std::to_string(tag.marker.id) + ": size " +
                 mm_text(patch.size_mm) + " mm, must be 5-200 mm"};
  }
  const double cell_mm = patch.size_mm / cells->border_cells;
  const double quiet_mm = quiet_cells * cell_mm;
  patch.around_mm = cells->overhang_cells() * cell_mm + quiet_mm;
  patch.cells = std::move(*cells);
  label(patch, tag, font);
  if (!tag.name.empty()) {
    patch.captions.push_back(tag.name);
  }
  patch.captions.push_back("quiet zone " + mm_text(quiet_mm) + " mm");
  return patch;
}

Vec2 add_patch(Sheet& sheet, const TagPatch& patch, double x_mm, double y_mm) {
  const double middle_mm = x_mm + patch.width_mm() / 2;
  const double quiet_top_mm = y_mm + patch.top_mm();
  sheet.cuts.push_back(cut_of(patch, middle_mm - patch.cut_width_mm / 2, y_mm));
  add_up_mark(sheet, patch, middle_mm, y_mm);
  add_tag(sheet, patch.cells, middle_mm - patch.size_mm / 2, quiet_top_mm + patch.around_mm,
          patch.size_mm);
  double baseline_mm = quiet_top_mm + patch.quiet_mm() + 1.05 * patch.text_mm;
  for (const std::string& row : patch.rows) {
    sheet.texts.push_back({middle_mm, baseline_mm, patch.text_mm, row, SheetAlign::kCentre});
    baseline_mm += TagPatch::kRowPitch * patch.text_mm;
  }
  baseline_mm = y_mm + patch.cut_height_mm() + kCaptionPitchMm;
  for (const std::string& caption : patch.captions) {
    sheet.texts.push_back({middle_mm, baseline_mm, kCaptionMm, caption, SheetAlign::kCentre});
    baseline_mm += kCaptionPitchMm;
  }
  return {middle_mm, quiet_top_mm + patch.quiet_mm() / 2};
}

}  // namespace orthonav::engine
