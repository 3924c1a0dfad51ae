#include "engine/print/board_file.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// Descriptions of calibration boards: what is read is written and read again to the same text.
void fuzz_board(std::span<const std::uint8_t> input) {
  const auto board = engine::parse_board(text_of(input), "board");
  if (!board) {
    insist_one_line(board.error());
    return;
  }
  const std::string text = engine::board_text(*board);
  const auto again = engine::parse_board(text, "again");
  insist(again.ok() && engine::board_text(*again) == text);
}

}  // namespace orthonav::fuzz
