#include "hal/sim/room/surface_map.h"

#include <algorithm>
#include <cmath>

namespace orthonav::sim {
namespace {

/// Neighbours further apart than this in depth lie on different parts of the bone.
constexpr double kDepthStep_m = 0.002;

}  // namespace

SurfaceMap::SurfaceMap(const RoomLevel& level, Vec3 from)
    : from_(from), u_axis_{from.y, -from.x, 0.0}, low_{1e9, 1e9}, high_{-1e9, -1e9} {
  for (const Vec3 vertex : level.vertices_m) {
    const Vec2 at = uv(vertex);
    low_ = {std::min(low_.x, at.x), std::min(low_.y, at.y)};
    high_ = {std::max(high_.x, at.x), std::max(high_.y, at.y)};
  }
  columns_ = static_cast<int>((high_.x - low_.x) / kStep_m) + 2;
  rows_ = static_cast<int>((high_.y - low_.y) / kStep_m) + 2;
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (const auto& triangle : level.triangles) {
    draw(level, triangle);
  }
}

void SurfaceMap::draw(const RoomLevel& level, const std::array<std::uint32_t, 3>& triangle) {
  const Vec3 a = level.vertices_m[triangle[0]];
  const Vec3 b = level.vertices_m[triangle[1]];
  const Vec3 c = level.vertices_m[triangle[2]];
  const Vec3 normal = (b - a).cross(c - a);
  // Triangles seen edge-on are invisible; those facing away are hidden by a closed bone.
  if (!(normal.dot(from_) > 1e-3 * normal.norm())) {
    return;
  }
  const Vec2 pa = uv(a);
  const Vec2 ab = uv(b) - pa;
  const Vec2 ac = uv(c) - pa;
  const double area = ab.x * ac.y - ab.y * ac.x;
  if (area == 0.0) {
    return;
  }
  const auto column_of = [this](double u) { return (u - low_.x) / kStep_m; };
  const auto row_of = [this](double v) { return (v - low_.y) / kStep_m; };
  const auto [u0, u1] = std::minmax({0.0, ab.x, ac.x});
  const auto [v0, v1] = std::minmax({0.0, ab.y, ac.y});
  for (int row = static_cast<int>(std::ceil(row_of(pa.y + v0))); row <= row_of(pa.y + v1); ++row) {
    for (int column = static_cast<int>(std::ceil(column_of(pa.x + u0)));
         column <= column_of(pa.x + u1); ++column) {
      const Vec2 d = Vec2{low_.x + column * kStep_m, low_.y + row * kStep_m} - pa;
      const double s = (d.x * ac.y - d.y * ac.x) / area;
      const double t = (ab.x * d.y - ab.y * d.x) / area;
      if (s < -1e-9 || t < -1e-9 || s + t > 1.0 + 1e-9) {
        continue;
      }
      const double height = from_.dot(a + s * (b - a) + t * (c - a));
      Cell& cell = cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                          static_cast<std::size_t>(column)];
      if (height > cell.height) {
        cell = {height, normal.normalized()};
      }
    }
  }
}

const SurfaceMap::Cell* SurfaceMap::cell(int column, int row) const {
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) {
    return nullptr;
  }
  const Cell& found = cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                             static_cast<std::size_t>(column)];
  return std::isfinite(found.height) ? &found : nullptr;
}

std::optional<BoneSpot> SurfaceMap::at(Vec2 uv_m) const {
  const double column = (uv_m.x - low_.x) / kStep_m;
  const double row = (uv_m.y - low_.y) / kStep_m;
  if (!(column >= 0.0 && row >= 0.0 && column < columns_ && row < rows_)) {
    return std::nullopt;
  }
  const int i = static_cast<int>(column);
  const int j = static_cast<int>(row);
  const double s = column - i;
  const double t = row - j;
  double height = 0.0;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  Vec3 normal;
  for (int corner = 0; corner < 4; ++corner) {
    const Cell* found = cell(i + corner % 2, j + corner / 2);
    if (!found) {
      return std::nullopt;
    }
    const double weight = (corner % 2 == 1 ? s : 1.0 - s) * (corner / 2 == 1 ? t : 1.0 - t);
    height += weight * found->height;
    normal += weight * found->normal;
    low = std::min(low, found->height);
    high = std::max(high, found->height);
  }
  if (high - low > kDepthStep_m || normal.squared_norm() < 0.25) {
    return std::nullopt;
  }
  return BoneSpot{uv_m.x * u_axis_ + Vec3{0, 0, uv_m.y} + height * from_, normal.normalized()};
}

}  // namespace orthonav::sim
