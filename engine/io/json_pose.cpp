#include "engine/io/json_pose.h"

#include <algorithm>
#include <vector>

namespace orthonav::engine {

std::array<double, 16> pose_rows(const JsonNode& node, const char* key, double metres_per_unit) {
  const std::vector<double> numbers = node.numbers(key, 16);
  std::array<double, 16> rows{};
  std::copy(numbers.begin(), numbers.end(), rows.begin());
  for (const std::size_t i : {3u, 7u, 11u}) {
    rows[i] *= metres_per_unit;
  }
  const bool affine = rows[12] == 0 && rows[13] == 0 && rows[14] == 0 && rows[15] == 1;
  if (!affine) {
    node.refuse(key, "must end with the row 0 0 0 1");
  }
  return rows;
}

}  // namespace orthonav::engine
