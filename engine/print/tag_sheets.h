#pragma once

#include <string>
#include <vector>

#include "engine/print/page.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// A tag to print and cut out.
struct PrintedTag {
  nav::MarkerDefinition marker;
  std::string name;  ///< of its tool; may be empty
};

struct TagSheetOptions {
  Page page;
  /// White around the tag, in cells of the tag, 1-4; text stays outside it.
  double quiet_cells = 1.0;
};

/// Where a tag was placed: its centre in millimetres on sheet number `sheet`.
struct PlacedTag {
  std::size_t sheet = 0;
  double x_mm = 0.0;
  double y_mm = 0.0;
  double size_mm = 0.0;
};

struct TagSheets {
  std::vector<Sheet> sheets;
  std::vector<PlacedTag> placed;  ///< in the order of the tags
};

/// The tags row by row on as many pages as they need, each to be cut out with its id, size and the
/// mark of its upper side (`tag_patch.h`). Refuses, with size and limit, a tag
/// that does not fit the page, unknown families and ids, sizes outside 5-200 mm, and more than 1000
/// tags.
Result<TagSheets> tag_sheets(const std::vector<PrintedTag>& tags, const TagSheetOptions& options);

}  // namespace orthonav::engine
