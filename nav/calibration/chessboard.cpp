#include "nav/calibration/chessboard.h"

#include <algorithm>
#include <cmath>

#include "nav/tracking/bilinear.h"

namespace orthonav::nav {
namespace {

constexpr int kFewest = 3;
constexpr int kMaxSquares = 50;
constexpr double kSmallestM = 0.001;
constexpr double kLargestM = 0.5;

/// Mean grey of the squares with the first inner square's colour, minus that of the others.
double first_colour(const GreyImage& image, const Chessboard& board,
                    const std::vector<Vec2>& corners_px) {
  double brighter = 0.0;
  for (int row = 0; row + 1 < board.rows; ++row) {
    for (int column = 0; column + 1 < board.columns; ++column) {
      const auto i = static_cast<std::size_t>(row * board.columns + column);
      const auto below = i + static_cast<std::size_t>(board.columns);
      const Vec2 centre =
          0.25 * (corners_px[i] + corners_px[i + 1] + corners_px[below] + corners_px[below + 1]);
      brighter += ((row + column) % 2 == 0 ? 1.0 : -1.0) * grey_at(image, centre);
    }
  }
  return brighter;
}

}  // namespace

std::vector<std::string> Chessboard::check() const {
  std::vector<std::string> problems;
  const auto count = [&](const char* what, int value) {
    if (value < kFewest || value > kMaxSquares) {
      problems.push_back(std::string("chessboard: ") + std::to_string(value) + " " + what +
                         " of inner corners, must be 3-50");
    }
  };
  count("columns", columns);
  count("rows", rows);
  if (columns == rows) {
    problems.push_back(
        "chessboard: " + std::to_string(columns) +
        " columns and as many rows of inner corners: how it is turned can't be told");
  }
  if (!(square_m >= kSmallestM && square_m <= kLargestM)) {
    problems.push_back("chessboard: squares of " + std::to_string(square_m * 1e3) +
                       " mm, must be 1-500 mm");
  }
  return problems;
}

Vec2 Chessboard::corner_m(std::size_t index) const {
  const auto a_row = static_cast<std::size_t>(columns);
  return {square_m * static_cast<double>(index % a_row),
          square_m * static_cast<double>(index / a_row)};
}

void put_in_order(const GreyImage& image, const Chessboard& board, std::vector<Vec2>& corners_px) {
  const auto a_row = static_cast<std::size_t>(board.columns);
  const Vec2 along = corners_px[a_row - 1] - corners_px[0];
  const Vec2 down = corners_px[corners_px.size() - a_row] - corners_px[0];
  // A mirrored order would mean a board seen from behind.
  if (along.cross(down) < 0) {
    for (std::size_t start = 0; start < corners_px.size(); start += a_row) {
      std::reverse(corners_px.begin() + static_cast<long>(start),
                   corners_px.begin() + static_cast<long>(start + a_row));
    }
  }
  if (!board.looks_the_same_rotated() && first_colour(image, board, corners_px) > 0) {
    std::reverse(corners_px.begin(), corners_px.end());
  }
}

}  // namespace orthonav::nav
