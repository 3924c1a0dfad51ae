#include "engine/print/board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "engine/print/board_file.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

Board april_grid() {
  Board board;
  board.columns = 3;
  board.rows = 2;
  board.size_m = 0.020;
  board.gap_m = 0.006;
  board.border_cells = 2;
  board.ids = consecutive_ids(board.kind, board.columns, board.rows, 10);
  return board;
}

Board chessboard() {
  Board board;
  board.kind = BoardKind::kChessboard;
  board.family.clear();
  board.columns = 7;
  board.rows = 5;
  board.size_m = 0.025;
  board.border_cells = 0;
  return board;
}

std::string problem_of(const std::function<void(Board&)>& change) {
  Board board = april_grid();
  change(board);
  const auto problems = problems_of(board);
  return problems.empty() ? "" : problems.front();
}

TEST(Board, NumbersAnAprilGridFromTheBottomAsKalibrDoes) {
  EXPECT_THAT(consecutive_ids(BoardKind::kAprilGrid, 3, 2, 10),
              ElementsAre(13, 14, 15, 10, 11, 12));
  EXPECT_THAT(consecutive_ids(BoardKind::kTags, 3, 2, 10), ElementsAre(10, 11, 12, 13, 14, 15));
  EXPECT_THAT(consecutive_ids(BoardKind::kChessboard, 3, 2, 10), IsEmpty());
}

TEST(Board, PutsItsOriginAtTheBottomLeftCorner) {
  const Board board = april_grid();
  EXPECT_NEAR(board.width_m(), 0.072, 1e-12);
  EXPECT_NEAR(board.height_m(), 0.046, 1e-12);
  // Index 3 is the first of the bottom row.
  const auto first = tag_corners_m(board, 3);
  EXPECT_EQ(first[0], (Vec2{0, 0}));
  EXPECT_EQ(first[2], (Vec2{0.020, 0.020}));
  const auto last = tag_corners_m(board, 2);
  EXPECT_NEAR(last[2].x, board.width_m(), 1e-12);
  EXPECT_NEAR(last[2].y, board.height_m(), 1e-12);
}

TEST(Board, SpreadsTouchPointsOverCornersThatAreThere) {
  const Board board = april_grid();
  const auto points = touch_points(board);
  ASSERT_EQ(points.size(), 9u);
  EXPECT_NEAR(points[0].at_m.x, 0.0, 1e-12);
  EXPECT_NEAR(points[0].at_m.y, 0.046, 1e-12);
  EXPECT_NEAR(points[8].at_m.x, 0.072, 1e-12);
  EXPECT_NEAR(points[8].at_m.y, 0.0, 1e-12);
  for (const TouchPoint& point : points) {
    bool is_corner = false;
    for (std::size_t tag = 0; tag < board.ids.size(); ++tag) {
      for (const Vec2 corner : tag_corners_m(board, tag)) {
        is_corner = is_corner || (corner - point.at_m).norm() < 1e-9;
      }
    }
    EXPECT_TRUE(is_corner) << point.at_m.x << " " << point.at_m.y;
  }
  Board single = board;
  single.columns = single.rows = 1;
  EXPECT_EQ(touch_points(single).size(), 4u);
}

TEST(Board, TouchesInnerCornersOfAChessboard) {
  const Board board = chessboard();
  const auto points = touch_points(board);
  ASSERT_EQ(points.size(), 9u);
  for (const TouchPoint& point : points) {
    const Vec2 square = (1.0 / board.size_m) * point.at_m;
    EXPECT_NEAR(square.x, std::round(square.x), 1e-7);
    EXPECT_NEAR(square.y, std::round(square.y), 1e-7);
    EXPECT_TRUE(square.x > 0.5 && square.x < board.columns - 0.5) << square.x;
    EXPECT_TRUE(square.y > 0.5 && square.y < board.rows - 0.5) << square.y;
  }
  EXPECT_NEAR(points.front().at_m.x, 0.025, 1e-12);
  EXPECT_NEAR(points.front().at_m.y, 0.100, 1e-12);
}

TEST(Board, NamesProblemsWithValueAndLimit) {
  EXPECT_THAT(problems_of(april_grid()), IsEmpty());
  EXPECT_THAT(problems_of(chessboard()), IsEmpty());
  EXPECT_THAT(problem_of([](Board& b) { b.columns = 51; }), HasSubstr("columns 51, must be 1-50"));
  EXPECT_THAT(problem_of([](Board& b) { b.rows = 0; }), HasSubstr("rows 0, must be 1-50"));
  EXPECT_THAT(problem_of([](Board& b) { b.size_m = 0.6; }),
              HasSubstr("size 600 mm, must be 2-500"));
  EXPECT_THAT(problem_of([](Board& b) { b.ids[1] = 587; }), HasSubstr("tag id 587, must be 0-586"));
  EXPECT_THAT(problem_of([](Board& b) { b.ids[1] = b.ids[0]; }), HasSubstr("13 is there twice"));
  EXPECT_THAT(problem_of([](Board& b) { b.ids.pop_back(); }), HasSubstr("5 ids, must be 6"));
  EXPECT_THAT(problem_of([](Board& b) { b.family = "tag9"; }), HasSubstr("unknown tag family"));
  EXPECT_THAT(problem_of([](Board& b) { b.border_cells = 1; }), HasSubstr("must be 2"));
  EXPECT_THAT(problem_of([](Board& b) { b.family = "tagStandard41h12"; }),
              HasSubstr("no black border"));
  Board three = chessboard();
  three.rows = 2;
  EXPECT_THAT(problems_of(three), ElementsAre(HasSubstr("rows 2, must be 3-50")));
}

TEST(Board, WantsACellOfWhiteBetweenTags) {
  // 20 mm with borders of two cells are ten cells of 2 mm.
  EXPECT_THAT(problem_of([](Board& b) { b.gap_m = 0.002; }), IsEmpty());
  EXPECT_THAT(problem_of([](Board& b) { b.gap_m = 0.00199; }),
              HasSubstr("gap 1.99 mm, must be 2 mm"));
}

TEST(BoardFile, ComesBackTheSame) {
  const test::TemporaryFolder folder;
  for (const Board& board : {april_grid(), chessboard()}) {
    ASSERT_TRUE(save_board(folder.file("board.json"), board));
    const auto back = load_board(folder.file("board.json"));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->kind, board.kind);
    EXPECT_EQ(back->family, board.family);
    EXPECT_EQ(back->ids, board.ids);
    EXPECT_EQ(back->columns, board.columns);
    EXPECT_EQ(back->rows, board.rows);
    EXPECT_DOUBLE_EQ(back->size_m, board.size_m);
    EXPECT_DOUBLE_EQ(back->gap_m, board.gap_m);
    EXPECT_EQ(back->border_cells, board.border_cells);
  }
}

/// The line that a board file is refused with, after the file's name.
std::string refusal(std::string text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  text.replace(at, part.size(), by);
  const test::TemporaryFolder folder;
  const auto board = load_board(folder.with("board.json", text));
  return board ? "" : board.error().message.substr(folder.file("").size());
}

TEST(BoardFile, RefusesWhatIsWrongInOneLine) {
  const std::string text = board_text(april_grid());
  const test::TemporaryFolder folder;
  ASSERT_TRUE(load_board(folder.with("board.json", text)));
  const std::vector<std::array<std::string, 3>> cases = {
      {"orthonav board", "board", "format is \"board\""},
      {"\"aprilgrid\"", "\"grid\"", "kind is \"grid\", must be aprilgrid, tags or chessboard"},
      {"\"columns\": 3", "\"columns\": 4", "ids holds 6 numbers, must be 8"},
      {"\"columns\": 3", "\"columns\": 1e8", "columns 100000000, must be 1-50"},
      {"\"columns\": 3", "\"columns\": -3", "columns -3, must be 1-50"},
      {"\"rows\"", "\"lines\"", "rows is missing"},
      {"\"size_mm\"", "\"size_m\"", "size_mm is missing"},
      {"\"size_mm\": 20.0", "\"size_mm\": \"20\"", "size_mm must be a number"},
      {"\"size_mm\": 20.0", "\"size_mm\": 0.02", "size 0.02 mm, must be 2-500 mm"},
      {"\"gap_mm\": 6", "\"gap_mm\": 1", "gap 1 mm, must be 2 mm"},
      {"tag36h11", "tag36h9", "unknown tag family"},
      {"\"border_cells\": 2", "\"border_cells\": 3", "border of 3 cells"},
      {"13", "13.5", "ids must be whole numbers"},
      {"13", "14", "tag id 14 is there twice"},
      {"13", "\"a\"", "ids must be a list"},
      {"{", "[", "is not JSON"},
  };
  for (const auto& [part, by, expected] : cases) {
    const std::string line = refusal(text, part, by);
    EXPECT_THAT(line, AllOf(StartsWith("board.json: "), HasSubstr(expected), Not(HasSubstr("\n"))));
  }
  EXPECT_THAT(load_board("/nowhere/board.json").error().message, HasSubstr("cannot be opened"));
}

}  // namespace
}  // namespace orthonav::engine
