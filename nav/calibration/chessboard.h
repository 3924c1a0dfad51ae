#pragma once

#include <string>
#include <vector>

#include "base/image.h"
#include "base/vec.h"

namespace orthonav::nav {

/// A chessboard by its inner corners, where four squares meet.
struct Chessboard {
  int columns = 9;
  int rows = 6;
  double square_m = 0.025;

  /// Every problem at once: counts outside 3-50, as many columns as rows (a quarter turn would go
  /// unnoticed), squares outside 1-500 mm.
  [[nodiscard]] std::vector<std::string> check() const;
  [[nodiscard]] std::size_t corners() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  /// Half a turn swaps the colours of most boards; if both counts are odd, or both even, it goes
  /// unnoticed.
  [[nodiscard]] bool looks_the_same_rotated() const { return (columns + rows) % 2 == 0; }
  /// Place of a corner on the board, counted by rows: x along the columns, y down the rows.
  [[nodiscard]] Vec2 corner_m(std::size_t index) const;
};

/// Puts corners that were found row by row into an order that is the same in every picture of the
/// board: as seen on its face, beginning where the first inner square is dark. On a board that
/// looks the same when turned, the order may begin at either end.
void put_in_order(const GreyImage& image, const Chessboard& board, std::vector<Vec2>& corners_px);

}  // namespace orthonav::nav
