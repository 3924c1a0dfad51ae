#include "engine/io/point_cloud.h"

#include <cmath>

#include "base/random.h"

namespace orthonav::engine {

std::size_t PointCloud::Hash::operator()(const Cell& cell) const {
  std::uint64_t state = 0;
  std::uint64_t hash = 0;
  for (const std::int64_t index : cell) {
    state = hash ^ static_cast<std::uint64_t>(index);
    hash = splitmix64(state);
  }
  return hash;
}

void PointCloud::add(Vec3 point_m) {
  if (cell_m_ > 0.0) {
    const auto index = [this](double x_m) {
      return static_cast<std::int64_t>(std::floor(x_m / cell_m_));
    };
    if (!taken_.insert({index(point_m.x), index(point_m.y), index(point_m.z)}).second) {
      return;
    }
  }
  points_m_.push_back({static_cast<float>(point_m.x), static_cast<float>(point_m.y),
                       static_cast<float>(point_m.z)});
}

}  // namespace orthonav::engine
