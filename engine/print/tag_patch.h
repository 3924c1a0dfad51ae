#pragma once

#include <string>
#include <vector>

#include "engine/print/tag_cells.h"
#include "engine/print/tag_sheets.h"
#include "engine/print/text_outline.h"

namespace orthonav::engine {

/// A tag and the paper that is cut out with it. Above its quiet zone the paper has a notch in the
/// middle of the edge and says which way is up; below it, it states the tag and its size, so that a
/// cut-out tag can still be identified and mounted the right way round.
struct TagPatch {
  TagCells cells;
  double size_mm = 0.0;
  double around_mm = 0.0;  ///< white from the tag's outer edge to that of the quiet zone
  double text_mm = 0.0;    ///< height of the font inside the cut
  double cut_width_mm = 0.0;
  std::vector<std::string> rows;      ///< inside the cut, below the quiet zone
  std::vector<std::string> captions;  ///< under the cut

  [[nodiscard]] double quiet_mm() const { return size_mm + 2 * around_mm; }
  [[nodiscard]] double top_mm() const { return 1.5 * text_mm; }
  [[nodiscard]] double bottom_mm() const {
    return (kRowPitch * static_cast<double>(rows.size()) + 0.2) * text_mm;
  }
  [[nodiscard]] double cut_height_mm() const { return top_mm() + quiet_mm() + bottom_mm(); }
  [[nodiscard]] double width_mm() const;
  [[nodiscard]] double height_mm() const;

  static constexpr double kRowPitch = 1.3;  ///< heights of the font
};

/// Refuses unknown families and ids, and sizes outside 5-200 mm.
Result<TagPatch> tag_patch(const PrintedTag& tag, double quiet_cells, const PrintFont& font);

/// Draws it with the top left corner of its paper at this place; returns the tag's centre.
Vec2 add_patch(Sheet& sheet, const TagPatch& patch, double x_mm, double y_mm);

}  // namespace orthonav::engine
