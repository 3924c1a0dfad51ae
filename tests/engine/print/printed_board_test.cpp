#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "engine/print/board_sheet.h"
#include "tests/engine/print/drawn_sheet.h"

namespace orthonav::engine::print_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

Board board_of(BoardKind kind) {
  Board board;
  board.kind = kind;
  board.columns = 6;
  board.rows = 7;
  board.size_m = 0.020;
  board.gap_m = 0.006;
  board.border_cells = kind == BoardKind::kAprilGrid ? 2 : 1;
  board.ids = consecutive_ids(kind, board.columns, board.rows, 0);
  if (kind == BoardKind::kChessboard) {
    board.family.clear();
    board.gap_m = 0.0;
    board.border_cells = 0;
  }
  return board;
}

void expect_every_tag_in_place(const std::map<int, Corners>& found, const Board& board,
                               const BoardSheet& sheet) {
  ASSERT_EQ(found.size(), board.ids.size());
  for (std::size_t i = 0; i < board.ids.size(); ++i) {
    Corners expected;
    const std::vector<Vec2> corners = tag_corners_m(board, i);
    for (std::size_t k = 0; k < 4; ++k) {
      expected[k] = {sheet.origin_x_mm + corners[k].x * 1e3,
                     sheet.origin_y_mm - corners[k].y * 1e3};
    }
    ASSERT_TRUE(found.contains(board.ids[i])) << board.ids[i];
    EXPECT_LT(farthest_mm(found.at(board.ids[i]), expected), kPlaceToleranceMm) << board.ids[i];
  }
}

TEST(PrintedBoard, HasEveryTagInPlace) {
  const Board board = board_of(BoardKind::kTags);
  const auto sheet = board_sheet(board, a4());
  ASSERT_TRUE(sheet) << sheet.error().message;
  expect_every_tag_in_place(detected(drawn(sheet->sheet), "tag36h11"), board, *sheet);
}

TEST(PrintedBoard, HasBordersOfTwoCellsOnAnAprilGrid) {
  const Board board = board_of(BoardKind::kAprilGrid);
  const auto sheet = board_sheet(board, a4());
  ASSERT_TRUE(sheet) << sheet.error().message;
  const GreyImage image = drawn(sheet->sheet);
  expect_every_tag_in_place(detected_with_wide_borders(image), board, *sheet);
  expect_every_tag_in_place(detected(image, "tag36h11b2"), board, *sheet);
  // The other way round: each border is read correctly.
  EXPECT_THAT(detected(image, "tag36h11"), IsEmpty());
  const auto plain = board_sheet(board_of(BoardKind::kTags), a4());
  ASSERT_TRUE(plain);
  // Some plain tags can be read with wide borders: their bits, sampled at cells of the wrong size,
  // happen to be those of the same or of another tag.
  EXPECT_LT(detected_with_wide_borders(drawn(plain->sheet)).size(), board.ids.size() / 2);
}

/// Whether the page is dark at a place of the board.
bool is_dark(const GreyImage& image, const BoardSheet& sheet, double x_mm, double y_mm) {
  const auto at = [](double mm) { return static_cast<int>(mm * kPxPerMm); };
  return image.at(at(sheet.origin_x_mm + x_mm), at(sheet.origin_y_mm - y_mm)) < 128;
}

TEST(PrintedBoard, HasBlackSquaresWhereTheGapsOfAnAprilGridCross) {
  const Board board = board_of(BoardKind::kAprilGrid);
  const auto sheet = board_sheet(board, a4());
  ASSERT_TRUE(sheet);
  const GreyImage image = drawn(sheet->sheet);
  // All squares at their corner away from the number, and the white between two of them.
  for (int row = 0; row <= board.rows; ++row) {
    for (int column = 0; column <= board.columns; ++column) {
      EXPECT_TRUE(is_dark(image, *sheet, column * 26 - 0.3, row * 26 - 5.7)) << row << column;
      EXPECT_TRUE(is_dark(image, *sheet, column * 26 - 5.7, row * 26 - 5.7)) << row << column;
      EXPECT_FALSE(is_dark(image, *sheet, column * 26 - 3, row * 26 + 0.3)) << row << column;
      EXPECT_FALSE(is_dark(image, *sheet, column * 26 + 0.3, row * 26 - 3)) << row << column;
    }
  }
}

TEST(PrintedBoard, AlternatesTheSquaresOfAChessboard) {
  const Board board = board_of(BoardKind::kChessboard);
  const auto sheet = board_sheet(board, a4());
  ASSERT_TRUE(sheet) << sheet.error().message;
  const GreyImage image = drawn(sheet->sheet);
  for (int up = 0; up < board.rows; ++up) {
    for (int column = 0; column < board.columns; ++column) {
      for (const double inside_mm : {0.2, 19.8}) {
        EXPECT_EQ(is_dark(image, *sheet, column * 20 + inside_mm, up * 20 + inside_mm),
                  (board.rows - 1 - up + column) % 2 == 0);
      }
    }
  }
  EXPECT_FALSE(is_dark(image, *sheet, -0.2, 139));
  EXPECT_FALSE(is_dark(image, *sheet, 1, 140.2));
}

TEST(PrintedBoard, RefusesWhatDoesNotFit) {
  Board board = board_of(BoardKind::kAprilGrid);
  board.columns = 7;
  board.ids = consecutive_ids(board.kind, 7, 7, 0);
  EXPECT_THAT(board_sheet(board, a4()).error().message,
              HasSubstr("AprilGrid, 7 x 7: 188 mm wide with its surround, page A4 has room "
                        "for 182 mm"));
  EXPECT_TRUE(board_sheet(board, *page_named("A3", false)));
  board.size_m = 0.0;
  EXPECT_THAT(board_sheet(board, a4()).error().message, HasSubstr("size 0 mm"));
}

}  // namespace
}  // namespace orthonav::engine::print_test
