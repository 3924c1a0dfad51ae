#pragma once

#include "engine/print/board.h"
#include "engine/print/page.h"

namespace orthonav::engine {

/// A board in the middle of its page.
struct BoardSheet {
  Sheet sheet;
  /// Where the board's origin lies on the page; the board's y goes up the page.
  double origin_x_mm = 0.0;
  double origin_y_mm = 0.0;
};

/// The board with its touch points numbered. Refuses, with cause, size and limit, an invalid board
/// and one that does not fit the page with white around it (a cell of a tag, half a square of a
/// chessboard).
Result<BoardSheet> board_sheet(const Board& board, const Page& page);

}  // namespace orthonav::engine
