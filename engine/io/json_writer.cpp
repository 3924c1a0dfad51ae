#include "engine/io/json_writer.h"

#include <nlohmann/json.hpp>

#include "engine/io/atomic_file.h"

namespace orthonav::engine {

nlohmann::ordered_json vector_mm(Vec3 v_m) { return {v_m.x * 1e3, v_m.y * 1e3, v_m.z * 1e3}; }

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

Status write_json(const std::string& path, const nlohmann::ordered_json& root) {
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;
  return write_file(path, root.dump(1, ' ', false, replace) + "\n");
}

}  // namespace orthonav::engine
