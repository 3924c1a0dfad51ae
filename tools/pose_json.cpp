#include "tools/pose_json.h"

#include <nlohmann/json.hpp>

namespace orthonav::tools {

nlohmann::ordered_json rows_mm(std::array<double, 16> row_major) {
  auto& a = row_major;
  for (const std::size_t i : {3u, 7u, 11u}) {
    a[i] *= 1e3;
  }
  nlohmann::ordered_json rows;
  for (std::size_t r = 0; r < 16; r += 4) {
    rows.push_back({a[r], a[r + 1], a[r + 2], a[r + 3]});
  }
  return rows;
}

}  // namespace orthonav::tools
