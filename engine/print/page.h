#pragma once

#include <array>
#include <string>
#include <string_view>

#include "base/result.h"
#include "engine/print/sheet.h"
#include "engine/print/tag_cells.h"

namespace orthonav::engine {

/// A paper size, upright.
struct PageSize {
  std::string_view name;
  double width_mm;
  double height_mm;
};

inline constexpr std::array<PageSize, 3> kPageSizes = {
    {{"A4", 210.0, 297.0}, {"Letter", 215.9, 279.4}, {"A3", 297.0, 420.0}}};

/// The chosen page.
struct Page {
  std::string name = "A4";
  double width_mm = 210.0;
  double height_mm = 297.0;
};
/// Refuses names that are not in `kPageSizes`.
Result<Page> page_named(const std::string& name, bool landscape);

/// The area between the margins, the heading and the rulers.
[[nodiscard]] SheetRect content_of(const Page& page);
/// Where the rulers' zeros are: the one along the page's width, and the one along its height.
[[nodiscard]] SheetRect horizontal_ruler(const Page& page);
[[nodiscard]] SheetRect vertical_ruler(const Page& page);

/// A page with nothing but a ruler of 100 mm in each direction to check the print with.
[[nodiscard]] Sheet blank_sheet(const Page& page);
void add_heading(Sheet& sheet, const std::string& heading);

/// Draws a tag with the top left corner of its size's square (outer edge of the border) there.
void add_tag(Sheet& sheet, const TagCells& tag, double x_mm, double y_mm, double size_mm);

/// A length for people: at most three decimals, none that are zero.
[[nodiscard]] std::string mm_text(double mm);

}  // namespace orthonav::engine
