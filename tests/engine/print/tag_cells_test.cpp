#include "engine/print/tag_cells.h"

#include <gtest/gtest.h>

#include "nav/tracking/marker_detector.h"

namespace orthonav::engine {
namespace {

/// Expects the printed tag to equal the tracked one, cell by cell.
void expect_alike(const TagCells& printed, const nav::TagTemplate& tracked) {
  ASSERT_EQ(printed.cells, tracked.cells);
  EXPECT_EQ(printed.border_cells, tracked.border_cells);
  for (int row = 0; row < printed.cells; ++row) {
    for (int column = 0; column < printed.cells; ++column) {
      EXPECT_EQ(printed.is_black(row, column), tracked.at(row, column) < 0.5F)
          << row << ", " << column;
    }
  }
}

TEST(TagCells, AreWhatIsTracked) {
  for (const char* family : {"tag36h11", "tag16h5", "tagStandard41h12", "tagCircle21h7"}) {
    const auto printed = tag_cells(family, 5);
    ASSERT_TRUE(printed.ok()) << printed.error().message;
    expect_alike(*printed, nav::tag_template(family, 5).value());
  }
}

TEST(TagCells, OfAWideBorderAreWhatIsTrackedWithAWideBorder) {
  for (const int id : {0, 7, 586}) {
    for (const auto& printed : {tag_cells("tag36h11", id, 2), tag_cells("tag36h11b2", id)}) {
      ASSERT_TRUE(printed.ok()) << printed.error().message;
      expect_alike(*printed, nav::tag_template("tag36h11b2", id).value());
    }
  }
}

}  // namespace
}  // namespace orthonav::engine
