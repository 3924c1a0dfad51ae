#pragma once

#include <array>
#include <string>

#include "base/result.h"
#include "base/transform.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

/// camera_from_rig of a calibration: 16 float32 for row vectors. Refuses an invalid rigid motion.
template <class A>
Result<Transform<A, Rig>> read_extrinsics(Bytes bytes) {
  std::array<double, 16> columns_first{};
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      columns_first[4 * column + row] = number_at<float>(bytes, 4 * (4 * row + column));
    }
  }
  for (std::size_t i = 12; i < 16; ++i) {
    if (columns_first[i] != (i == 15 ? 1.0 : 0.0)) {
      return Error{"calibration: last column of the extrinsics must be 0 0 0 1"};
    }
  }
  auto read = Transform<A, Rig>::from_row_major(columns_first);
  if (!read) {
    return Error{"calibration: extrinsics: " + read.error().message};
  }
  return read;
}

}  // namespace orthonav::hl2ss
