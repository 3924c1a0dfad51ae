#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/result.h"

namespace orthonav::replay {

/// The header of a binary PGM (P5); each number has at most nine digits.
struct PgmHeader {
  std::int64_t width_px = 0;
  std::int64_t height_px = 0;
  std::int64_t maximum = 0;  ///< grey
  std::size_t bytes = 0;     ///< up to the first pixel
};

/// Reads the header at the beginning of `bytes`. An Error continues "the image ...".
Result<PgmHeader> parse_pgm_header(std::string_view bytes);

}  // namespace orthonav::replay
