#include "engine/print/page.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "base/printed.h"

namespace orthonav::engine {
namespace {

// No printer reaches the edge of the paper.
constexpr double kMarginMm = 8.0;
constexpr double kHeadingMm = 9.0;
// The band of a ruler, with its numbers.
constexpr double kRulerBandMm = 12.0;
constexpr int kRulerMm = 100;
constexpr double kTickWidthMm = 0.15;
constexpr double kTextMm = 2.6;
constexpr double kHeadingTextMm = 3.2;
constexpr const char* kCheck = "measure 100 mm";

double tick_length_mm(int mm) { return mm % 10 == 0 ? 4.0 : (mm % 5 == 0 ? 3.0 : 2.0); }

// Ticks are centred on their millimetre; the line runs along the ends that the numbers don't use.
void add_horizontal_ruler(Sheet& sheet, const SheetRect& at) {
  SheetShape ticks;
  for (int mm = 0; mm <= kRulerMm; ++mm) {
    ticks.rects.push_back(
        {at.x_mm + mm - kTickWidthMm / 2, at.y_mm, kTickWidthMm, tick_length_mm(mm)});
    if (mm % 10 == 0) {
      sheet.texts.push_back({at.x_mm + mm, at.y_mm + 4.2 + kTextMm, kTextMm, std::to_string(mm),
                             SheetAlign::kCentre});
    }
  }
  ticks.rects.push_back(
      {at.x_mm - kTickWidthMm / 2, at.y_mm, kRulerMm + kTickWidthMm, kTickWidthMm});
  sheet.shapes.push_back(std::move(ticks));
  sheet.texts.push_back(
      {at.x_mm + kRulerMm + 5, at.y_mm + 2.8, kTextMm, "measure 100 mm, both rulers"});
  sheet.texts.push_back({at.x_mm + kRulerMm + 5, at.y_mm + 2.8 + 1.4 * kTextMm, kTextMm,
                         "Print at 100 %, never \"fit to page\"."});
}

void add_vertical_ruler(Sheet& sheet, const SheetRect& at) {
  SheetShape ticks;
  const double right_mm = at.x_mm + at.width_mm;
  for (int mm = 0; mm <= kRulerMm; ++mm) {
    const double length_mm = tick_length_mm(mm);
    const double y_mm = at.y_mm + at.height_mm - mm;
    ticks.rects.push_back({right_mm - length_mm, y_mm - kTickWidthMm / 2, length_mm, kTickWidthMm});
    if (mm % 10 == 0) {
      sheet.texts.push_back({right_mm - 4.6, y_mm, kTextMm, std::to_string(mm), SheetAlign::kCentre,
                             /*upward=*/true});
    }
  }
  ticks.rects.push_back(
      {right_mm - kTickWidthMm, at.y_mm - kTickWidthMm / 2, kTickWidthMm, kRulerMm + kTickWidthMm});
  sheet.shapes.push_back(std::move(ticks));
  sheet.texts.push_back({right_mm - 2.0, at.y_mm - 5, kTextMm, kCheck, SheetAlign::kLeft, true});
}

}  // namespace

Result<Page> page_named(const std::string& name, bool landscape) {
  std::string known;
  for (const PageSize& size : kPageSizes) {
    known += (known.empty() ? "" : ", ") + std::string(size.name);
    if (size.name != name) {
      continue;
    }
    Page page{name, size.width_mm, size.height_mm};
    if (landscape) {
      page.name += " landscape";
      std::swap(page.width_mm, page.height_mm);
    }
    return page;
  }
  return Error{"unknown page \"" + name + "\", known are " + known};
}

SheetRect content_of(const Page& page) {
  const double left_mm = kMarginMm + kRulerBandMm;
  const double top_mm = kMarginMm + kHeadingMm;
  return {left_mm, top_mm, page.width_mm - left_mm - kMarginMm,
          page.height_mm - top_mm - kRulerBandMm - kMarginMm};
}

SheetRect horizontal_ruler(const Page& page) {
  return {kMarginMm + kRulerBandMm, page.height_mm - kMarginMm - kRulerBandMm + 2.0, kRulerMm, 4.0};
}

SheetRect vertical_ruler(const Page& page) {
  const SheetRect content = content_of(page);
  return {kMarginMm + kRulerBandMm - 7.0, content.y_mm + content.height_mm - kRulerMm - 5.0, 4.0,
          kRulerMm};
}

Sheet blank_sheet(const Page& page) {
  Sheet sheet;
  sheet.width_mm = page.width_mm;
  sheet.height_mm = page.height_mm;
  add_horizontal_ruler(sheet, horizontal_ruler(page));
  add_vertical_ruler(sheet, vertical_ruler(page));
  return sheet;
}

void add_heading(Sheet& sheet, const std::string& heading) {
  sheet.texts.push_back(
      {kMarginMm + kRulerBandMm, kMarginMm + kHeadingTextMm, kHeadingTextMm, heading});
}

void add_tag(Sheet& sheet, const TagCells& tag, double x_mm, double y_mm, double size_mm) {
  const double cell_mm = size_mm / tag.border_cells;
  const double around = (tag.cells - tag.border_cells) / 2.0;
  SheetShape shape;
  for (int row = 0; row < tag.cells; ++row) {
    for (int column = 0; column < tag.cells;) {
      const int first = column;
      while (column < tag.cells && tag.is_black(row, column)) {
        ++column;
      }
      if (column > first) {
        shape.rects.push_back({x_mm + (first - around) * cell_mm, y_mm + (row - around) * cell_mm,
                               (column - first) * cell_mm, cell_mm});
      } else {
        ++column;
      }
    }
  }
  sheet.shapes.push_back(std::move(shape));
}

std::string mm_text(double mm) {
  std::string shown = printed("%.3f", mm);
  shown.erase(shown.find_last_not_of('0') + 1);
  if (shown.back() == '.') {
    shown.pop_back();
  }
  return shown;
}

}  // namespace orthonav::engine
