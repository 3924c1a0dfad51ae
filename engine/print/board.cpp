#include "engine/print/board.h"

#include <algorithm>
#include <set>

#include "base/printed.h"
#include "engine/print/tag_cells.h"
#include "nav/tracking/marker_detector.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {
namespace {

constexpr int kMaxAcross = 50;
constexpr int kFewestSquares = 3;
constexpr double kSmallestM = 0.002;
constexpr double kLargestM = 0.5;
// Sizes and gaps come as decimal millimetres, so their ratio may miss a whole number of cells by
// rounding.
constexpr double kRounding = 1e-9;

std::string in_mm(double metres) { return printed("%.6g mm", metres * 1e3); }

void check_counts(const Board& board, std::vector<std::string>& problems) {
  const int fewest = board.kind == BoardKind::kChessboard ? kFewestSquares : 1;
  const auto check = [&](const char* what, int count) {
    if (count < fewest || count > kMaxAcross) {
      problems.push_back(std::string(what) + " " + std::to_string(count) + ", must be " +
                         std::to_string(fewest) + "-" + std::to_string(kMaxAcross));
    }
  };
  check("columns", board.columns);
  check("rows", board.rows);
  if (!(board.size_m >= kSmallestM && board.size_m <= kLargestM)) {
    problems.push_back("size " + in_mm(board.size_m) + ", must be 2-500 mm");
  }
}

void check_ids(const Board& board, std::vector<std::string>& problems) {
  const auto wanted = static_cast<std::size_t>(board.columns) * board.rows;
  if (board.ids.size() != wanted) {
    problems.push_back(std::to_string(board.ids.size()) + " ids, must be " +
                       std::to_string(wanted) + " (columns x rows)");
  }
  const int known = nav::family_size(board.family);
  std::set<int> seen;
  for (const int id : board.ids) {
    if (id < 0 || id >= known) {
      return problems.push_back("tag id " + std::to_string(id) + ", must be 0-" +
                                std::to_string(known - 1));
    }
    if (!seen.insert(id).second) {
      return problems.push_back("tag id " + std::to_string(id) + " is there twice");
    }
  }
}

void check_border(const Board& board, std::vector<std::string>& problems) {
  if (board.kind == BoardKind::kAprilGrid && board.border_cells != 2) {
    return problems.push_back("border of " + std::to_string(board.border_cells) +
                              " cells, must be 2 on an AprilGrid");
  }
  const auto cells = tag_cells(board.family, 0, board.border_cells);
  if (!cells) {
    return problems.push_back(cells.error().message);
  }
  const double cell_m = board.size_m / cells->border_cells;
  const double least_m = (2 * cells->overhang_cells() + 1) * cell_m;
  if (!(board.gap_m >= least_m * (1.0 - kRounding) && board.gap_m <= kLargestM)) {
    problems.push_back("gap " + in_mm(board.gap_m) + ", must be " + in_mm(least_m) +
                       " (a cell of white) to 500 mm");
  }
}

void check_tags(const Board& board, std::vector<std::string>& problems) {
  if (!nav::is_known_family(board.family)) {
    return problems.push_back("unknown tag family '" + board.family + "', known are " +
                              nav::known_families_text());
  }
  check_ids(board, problems);
  check_border(board, problems);
}

/// First, middle and last of the lines that touch points lie on, along one axis.
struct Station {
  double at_m;
  double outward;
};

std::vector<Station> stations(const Board& board, int count) {
  if (board.kind == BoardKind::kChessboard) {
    std::set<int> lines = {1, count / 2, count - 1};
    std::vector<Station> out;
    for (const int line : lines) {
      out.push_back({line * board.size_m, 1.0});
    }
    return out;
  }
  std::vector<Station> out = {{0.0, -1.0}};
  if (count > 1) {
    out.push_back({count / 2 * board.pitch_m(), -1.0});
  }
  out.push_back({count * board.pitch_m() - board.gap_m, 1.0});
  return out;
}

}  // namespace

std::string to_text(BoardKind kind) {
  switch (kind) {
    case BoardKind::kTags:
      return "tags";
    case BoardKind::kAprilGrid:
      return "aprilgrid";
    case BoardKind::kChessboard:
      return "chessboard";
  }
  return {};
}

std::string in_words(BoardKind kind) {
  switch (kind) {
    case BoardKind::kTags:
      return "grid of tags";
    case BoardKind::kAprilGrid:
      return "AprilGrid";
    case BoardKind::kChessboard:
      return "chessboard";
  }
  return {};
}

std::vector<std::string> problems_of(const Board& board) {
  std::vector<std::string> problems;
  check_counts(board, problems);
  // The code below divides and multiplies by these.
  if (!problems.empty()) {
    return problems;
  }
  if (board.kind != BoardKind::kChessboard) {
    check_tags(board, problems);
  } else if (!board.ids.empty() || board.gap_m != 0.0 || board.border_cells != 0) {
    problems.push_back("a chessboard has no ids, no gap and no border");
  }
  return problems;
}

std::vector<int> consecutive_ids(BoardKind kind, int columns, int rows, int first_id) {
  std::vector<int> ids;
  if (kind == BoardKind::kChessboard) {
    return ids;
  }
  for (int row = 0; row < rows; ++row) {
    const int numbered = kind == BoardKind::kAprilGrid ? rows - 1 - row : row;
    for (int column = 0; column < columns; ++column) {
      ids.push_back(first_id + numbered * columns + column);
    }
  }
  return ids;
}

std::vector<Vec2> tag_corners_m(const Board& board, std::size_t index) {
  const auto column = static_cast<int>(index % static_cast<std::size_t>(board.columns));
  const auto row = static_cast<int>(index / static_cast<std::size_t>(board.columns));
  const double x = column * board.pitch_m();
  const double y = (board.rows - 1 - row) * board.pitch_m();
  const double s = board.size_m;
  return {{x, y}, {x + s, y}, {x + s, y + s}, {x, y + s}};
}

std::vector<TouchPoint> touch_points(const Board& board) {
  const std::vector<Station> across = stations(board, board.columns);
  std::vector<Station> upward = stations(board, board.rows);
  std::reverse(upward.begin(), upward.end());
  std::vector<TouchPoint> points;
  for (const Station& y : upward) {
    for (const Station& x : across) {
      points.push_back({{x.at_m, y.at_m}, {x.outward, y.outward}});
    }
  }
  return points;
}

}  // namespace orthonav::engine
