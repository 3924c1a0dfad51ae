#include "engine/print/board_file.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/joined.h"
#include "base/units.h"
#include "engine/io/atomic_file.h"
#include "engine/io/json_document.h"

namespace orthonav::engine {
namespace {

constexpr const char* kFormat = "orthonav board";
// Larger counts are refused without reading the list.
constexpr int kMaxInFile = 1000;

std::optional<BoardKind> kind_from(const std::string& text) {
  for (const BoardKind kind : {BoardKind::kTags, BoardKind::kAprilGrid, BoardKind::kChessboard}) {
    if (to_text(kind) == text) {
      return kind;
    }
  }
  return std::nullopt;
}

void read_tags(const JsonNode& node, Board& board) {
  board.family = node.text("family");
  board.gap_m = node.number("gap_mm") * kMetresPerMm;
  board.border_cells = node.integer("border_cells");
  if (board.columns < 1 || board.columns > kMaxInFile || board.rows < 1 ||
      board.rows > kMaxInFile) {
    return;  // `problems_of` says so
  }
  const auto count = static_cast<std::size_t>(board.columns * board.rows);
  for (const double id : node.numbers("ids", count)) {
    if (id != std::floor(id) || std::abs(id) > 1e9) {
      node.refuse("ids", "must be whole numbers");
      return;
    }
    board.ids.push_back(static_cast<int>(id));
  }
}

/// Millimetres without the extra digits from the conversion to metres.
double mm_of(double metres) { return std::round(metres * 1e9) / 1e6; }

}  // namespace

Result<Board> load_board(const std::string& path) {
  const Result<JsonDocument> document = JsonDocument::read(path);
  if (!document) {
    return document.error();
  }
  const JsonNode root = document->root();
  const std::string format = root.text("format");
  if (format != kFormat) {
    root.refuse("format", "is \"" + format + "\", must be \"" + kFormat + "\"");
  }
  Board board;
  const std::string kind = root.text("kind");
  if (const auto known = kind_from(kind)) {
    board.kind = *known;
  } else {
    root.refuse("kind", "is \"" + kind + "\", must be aprilgrid, tags or chessboard");
  }
  board.columns = root.integer("columns");
  board.rows = root.integer("rows");
  board.size_m = root.number("size_mm") * kMetresPerMm;
  if (board.kind == BoardKind::kChessboard) {
    board.family.clear();
    board.border_cells = 0;
  } else {
    read_tags(root, board);
  }
  if (Status status = document->status(); !status) {
    return status.error();
  }
  const std::vector<std::string> problems = problems_of(board);
  if (problems.empty()) {
    return board;
  }
  return Error{path + ": " + joined(problems)};
}

std::string board_text(const Board& board) {
  nlohmann::ordered_json root = {{"format", kFormat},
                                 {"kind", to_text(board.kind)},
                                 {"columns", board.columns},
                                 {"rows", board.rows},
                                 {"size_mm", mm_of(board.size_m)}};
  if (board.kind != BoardKind::kChessboard) {
    root["gap_mm"] = mm_of(board.gap_m);
    root["family"] = board.family;
    root["border_cells"] = board.border_cells;
    root["ids"] = nlohmann::ordered_json::array();
    const auto columns = static_cast<std::size_t>(board.columns);
    for (std::size_t i = 0; i + columns <= board.ids.size(); i += columns) {
      const auto first = board.ids.begin() + static_cast<std::ptrdiff_t>(i);
      root["ids"].push_back(std::vector<int>(first, first + board.columns));
    }
  }
  return root.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Status save_board(const std::string& path, const Board& board) {
  return write_file(path, board_text(board));
}

}  // namespace orthonav::engine
