#include <vector>

#include "engine/print/board_file.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// Descriptions of calibration boards: what is read is written and read again to the same text.
void fuzz_board(std::span<const std::uint8_t> input) {
  const auto board = engine::load_board(InputFile(input).path());
  if (!board) {
    insist_one_line(board.error());
    return;
  }
  const std::string text = engine::board_text(*board);
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  const auto again = engine::load_board(InputFile(bytes).path());
  insist(again.ok() && engine::board_text(*again) == text);
}

}  // namespace orthonav::fuzz
