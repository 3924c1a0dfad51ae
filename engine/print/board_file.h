#pragma once

#include <string>

#include "base/result.h"
#include "engine/print/board.h"

namespace orthonav::engine {

/// Reads a board file, as `print board` writes it next to its PDF: `{"format": "orthonav board",
/// "kind": "aprilgrid"|"tags"|"chessboard", "columns", "rows", "size_mm"}`, and for tags
/// `"family"`, `"ids"` (lists by rows, the top row first), `"gap_mm"`, `"border_cells"`. Refuses,
/// naming file and field, missing fields, wrong types, and problems in the sense of `problems_of`.
Result<Board> load_board(const std::string& path);
/// The text of a board's file.
[[nodiscard]] std::string board_text(const Board& board);
/// Writes a file that `load_board` reads back.
Status save_board(const std::string& path, const Board& board);

}  // namespace orthonav::engine
