#pragma once

#include <string>
#include <vector>

#include "base/vec.h"

namespace orthonav::engine {

enum class BoardKind {
  kTags,       ///< tags in rows and columns with white between them
  kAprilGrid,  ///< Kalibr's: borders two cells wide, black squares where the gaps cross
  kChessboard
};

/// A flat printed board. Its frame: origin at the bottom left corner of the bottom left tag (outer
/// edge of the border) or square, x right, y up, z out of the face.
struct Board {
  BoardKind kind = BoardKind::kAprilGrid;
  std::string family = "tag36h11";
  std::vector<int> ids;  ///< by rows as printed, the top row first; none on a chessboard
  int columns = 0;       ///< tags, or squares of a chessboard
  int rows = 0;
  double size_m = 0.0;   ///< outer edge of a tag's border, or edge of a square
  double gap_m = 0.0;    ///< between the borders of neighbours; 0 on a chessboard
  int border_cells = 1;  ///< width of a tag's border; 0 on a chessboard

  [[nodiscard]] double pitch_m() const { return size_m + gap_m; }
  /// From the first tag's (square's) outer edge to the last one's.
  [[nodiscard]] double width_m() const { return columns * pitch_m() - gap_m; }
  [[nodiscard]] double height_m() const { return rows * pitch_m() - gap_m; }
};

/// "tags", "aprilgrid" or "chessboard".
[[nodiscard]] std::string to_text(BoardKind kind);
/// For people: "chessboard", "AprilGrid", "grid of tags".
[[nodiscard]] std::string in_words(BoardKind kind);

/// Every problem at once, each with value and limit: counts outside 1-50 (squares: 3-50), sizes
/// outside 2-500 mm, ids that are unknown, repeated or wrong in number, gaps between tags of less
/// than one white cell or over 500 mm, borders that the kind or the family does not have.
[[nodiscard]] std::vector<std::string> problems_of(const Board& board);

/// Default numbering of ids: by rows, from the bottom row for an AprilGrid (Kalibr), from the top
/// row for other tags; none for a chessboard.
[[nodiscard]] std::vector<int> consecutive_ids(BoardKind kind, int columns, int rows, int first_id);

/// The outer corners of a tag's border in the order of `nav::MarkerCorners`: bottom left, bottom
/// right, top right, top left. `index` counts as `ids` does.
[[nodiscard]] std::vector<Vec2> tag_corners_m(const Board& board, std::size_t index);

/// A corner to touch with the pointer, and the direction in which there is room beside it.
struct TouchPoint {
  Vec2 at_m;
  Vec2 outward;  ///< each component -1 or 1
};

/// Up to nine corners spread over the board, by rows from the top left, as numbered on the print:
/// of tags the outermost corners and those near the middle, of a chessboard the inner corners.
[[nodiscard]] std::vector<TouchPoint> touch_points(const Board& board);

}  // namespace orthonav::engine
