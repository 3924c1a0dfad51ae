#pragma once

#include <array>

#include "base/transform.h"
#include "engine/io/json_document.h"

namespace orthonav::engine {

/// The numbers of a pose in a file: 4×4 by rows, with lengths converted from the file's units to
/// metres. Notes a last row that is not 0 0 0 1.
[[nodiscard]] std::array<double, 16> pose_rows(const JsonNode& node, const char* key,
                                               double metres_per_unit);

/// The rigid pose of such rows. If it is invalid, notes the problem and returns the identity.
template <class To, class From>
[[nodiscard]] Transform<To, From> rigid_pose(const JsonNode& node, const char* key,
                                             const std::array<double, 16>& rows) {
  // Numbers rounded to four digits still count as rigid.
  constexpr double kMaxShear = 1e-3;
  const auto pose = Transform<To, From>::from_row_major(rows, kMaxShear);
  if (!pose) {
    node.refuse(key, pose.error().message);
    return {};
  }
  return *pose;
}

}  // namespace orthonav::engine
