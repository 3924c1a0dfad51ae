#include "engine/print/board_sheet.h"

#include <algorithm>

#include "base/how_many.h"

namespace orthonav::engine {
namespace {

// A number and a stroke from it towards its corner, in shares of the free square beside the corner;
// both stay clear of the edges that cameras measure.
constexpr double kMaxRoomMm = 8.0;
constexpr double kNumberHeight = 0.42;
constexpr double kNumberAt = 0.62;
constexpr double kStrokeFrom = 0.38;
constexpr double kStrokeTo = 0.16;
// From the middle of a digit to its baseline, in heights of the font.
constexpr double kHalfDigit = 0.36;

std::string heading_of(const Board& board) {
  const std::string across = std::to_string(board.columns) + " x " + std::to_string(board.rows);
  if (board.kind == BoardKind::kChessboard) {
    return "Chessboard " + across + " squares of " + mm_text(board.size_m * 1e3) + " mm";
  }
  const auto [low, high] = std::minmax_element(board.ids.begin(), board.ids.end());
  return (board.kind == BoardKind::kAprilGrid ? "AprilGrid " : "Tag grid ") + across + ", " +
         board.family + " id " + std::to_string(*low) + "-" + std::to_string(*high) + ", size " +
         mm_text(board.size_m * 1e3) + " mm, gap " + mm_text(board.gap_m * 1e3) + " mm, border " +
         how_many(board.border_cells, "cell");
}

/// The margin that has to stay free or black around the outermost edges.
double surround_mm(const Board& board) {
  if (board.kind == BoardKind::kChessboard) {
    return board.size_m * 1e3 / 2;
  }
  if (board.kind == BoardKind::kAprilGrid) {
    return board.gap_m * 1e3;
  }
  const auto cells = tag_cells(board.family, board.ids.front(), board.border_cells);
  return cells ? (cells->overhang_cells() + 1) * board.size_m * 1e3 / cells->border_cells : 0.0;
}

Status fits(const Board& board, const Page& page) {
  const SheetRect content = content_of(page);
  const double around_mm = 2 * surround_mm(board);
  const auto check = [&](const char* direction, double taken_mm, double room_mm) -> Status {
    if (taken_mm <= room_mm) {
      return {};
    }
    return Error{in_words(board.kind) + ", " + std::to_string(board.columns) + " x " +
                 std::to_string(board.rows) + ": " + mm_text(taken_mm) + " mm " + direction +
                 " with its surround, page " + page.name + " has room for " + mm_text(room_mm) +
                 " mm"};
  };
  if (Status s = check("wide", board.width_m() * 1e3 + around_mm, content.width_mm); !s) {
    return s;
  }
  return check("high", board.height_m() * 1e3 + around_mm, content.height_mm);
}

/// From the board's frame to the page.
struct Placed {
  const Board& board;
  double origin_x_mm;
  double origin_y_mm;

  [[nodiscard]] double x_mm(double x_m) const { return origin_x_mm + x_m * 1e3; }
  [[nodiscard]] double y_mm(double y_m) const { return origin_y_mm - y_m * 1e3; }
};

Status add_tags(Sheet& sheet, const Placed& placed) {
  const Board& board = placed.board;
  for (std::size_t i = 0; i < board.ids.size(); ++i) {
    const auto cells = tag_cells(board.family, board.ids[i], board.border_cells);
    if (!cells) {
      return cells.error();
    }
    const Vec2 top_left = tag_corners_m(board, i)[3];
    add_tag(sheet, *cells, placed.x_mm(top_left.x), placed.y_mm(top_left.y), board.size_m * 1e3);
  }
  return {};
}

/// The black squares where the gaps of an AprilGrid cross, the outermost included.
void add_crossings(Sheet& sheet, const Placed& placed) {
  const Board& board = placed.board;
  SheetShape squares;
  for (int row = 0; row <= board.rows; ++row) {
    for (int column = 0; column <= board.columns; ++column) {
      squares.rects.push_back({placed.x_mm(column * board.pitch_m() - board.gap_m),
                               placed.y_mm(row * board.pitch_m()), board.gap_m * 1e3,
                               board.gap_m * 1e3});
    }
  }
  sheet.shapes.push_back(std::move(squares));
}

void add_squares(Sheet& sheet, const Placed& placed) {
  const Board& board = placed.board;
  const double size_mm = board.size_m * 1e3;
  SheetShape squares;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = row % 2; column < board.columns; column += 2) {
      squares.rects.push_back({placed.x_mm(column * board.size_m),
                               placed.y_mm((board.rows - row) * board.size_m), size_mm, size_mm});
    }
  }
  sheet.shapes.push_back(std::move(squares));
}

/// Whether the square of a chessboard beside a touch point is black.
bool black_beside(const Board& board, const TouchPoint& point) {
  const auto column =
      static_cast<int>((point.at_m.x + point.outward.x * board.size_m / 2) / board.size_m);
  const auto up =
      static_cast<int>((point.at_m.y + point.outward.y * board.size_m / 2) / board.size_m);
  return (board.rows - 1 - up + column) % 2 == 0;
}

void add_numbers(Sheet& sheet, const Placed& placed) {
  const Board& board = placed.board;
  const bool chessboard = board.kind == BoardKind::kChessboard;
  const double room_mm = std::min(kMaxRoomMm, (chessboard ? board.size_m : board.gap_m) * 1e3);
  const double height_mm = kNumberHeight * room_mm;
  int number = 0;
  for (const TouchPoint& point : touch_points(board)) {
    const auto x_mm = [&](double fraction) {
      return placed.x_mm(point.at_m.x) + point.outward.x * fraction * room_mm;
    };
    const auto y_mm = [&](double fraction) {
      return placed.y_mm(point.at_m.y) - point.outward.y * fraction * room_mm;
    };
    const bool on_black =
        board.kind == BoardKind::kAprilGrid || (chessboard && black_beside(board, point));
    sheet.texts.push_back({x_mm(kNumberAt), y_mm(kNumberAt) + kHalfDigit * height_mm, height_mm,
                           std::to_string(++number), SheetAlign::kCentre, false, on_black});
    sheet.lines.push_back({x_mm(kStrokeFrom), y_mm(kStrokeFrom), x_mm(kStrokeTo), y_mm(kStrokeTo),
                           0.03 * room_mm, on_black});
  }
}

}  // namespace

Result<BoardSheet> board_sheet(const Board& board, const Page& page) {
  if (const auto problems = problems_of(board); !problems.empty()) {
    return Error{in_words(board.kind) + ": " + problems.front()};
  }
  if (Status s = fits(board, page); !s) {
    return s.error();
  }
  const SheetRect content = content_of(page);
  BoardSheet out;
  out.sheet = blank_sheet(page);
  out.origin_x_mm = content.x_mm + (content.width_mm - board.width_m() * 1e3) / 2;
  out.origin_y_mm = content.y_mm + (content.height_mm + board.height_m() * 1e3) / 2;
  const Placed placed{board, out.origin_x_mm, out.origin_y_mm};
  if (board.kind == BoardKind::kChessboard) {
    add_squares(out.sheet, placed);
  } else if (Status s = add_tags(out.sheet, placed); !s) {
    return s.error();
  }
  if (board.kind == BoardKind::kAprilGrid) {
    add_crossings(out.sheet, placed);
  }
  add_numbers(out.sheet, placed);
  add_heading(out.sheet, heading_of(board));
  return out;
}

}  // namespace orthonav::engine
