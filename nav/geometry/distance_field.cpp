#include "nav/geometry/distance_field.h"

#include <cmath>

namespace orthonav::nav {
namespace {

/// Farther from the surface nobody asks on which side a point lies.
constexpr double kSigned_m = 0.008;

}  // namespace

DistanceField::DistanceField(const TriangleMesh& mesh, const SurfaceIndex& near,
                             const SurfaceIndex& bone, double cell_m, double margin_m)
    : cell_m_(cell_m) {
  const Bounds box = bounds_of(mesh);
  const Vec3 margin{margin_m, margin_m, margin_m};
  bounds_.low = box.low - margin;
  const Vec3 extent = box.high + margin - bounds_.low;
  for (std::size_t k = 0; k < 3; ++k)
    size_[k] = static_cast<int>(std::ceil(extent[static_cast<int>(k)] / cell_m)) + 1;
  bounds_.high = bounds_.low + cell_m * Vec3{size_[0] - 1.0, size_[1] - 1.0, size_[2] - 1.0};
  distance_m_.reserve(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
                      static_cast<std::size_t>(size_[2]));
  for (int z = 0; z < size_[2]; ++z)
    for (int y = 0; y < size_[1]; ++y) {
      double before_m = 1e9;
      for (int x = 0; x < size_[0]; ++x) {
        const Vec3 query =
            bounds_.low +
            cell_m * Vec3{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        // Nothing is farther than the neighbour's distance and the step to it.
        const auto found = near.nearest(query, before_m + cell_m * (1.0 + 1e-9));
        const double distance = found ? found->distance_m : before_m + cell_m;
        const bool inside = distance < kSigned_m && bone.contains(query);
        before_m = distance;
        distance_m_.push_back(static_cast<float>(inside ? -distance : distance));
      }
    }
}

bool DistanceField::at(Vec3 query_m, Value& value) const {
  const Vec3 p = (query_m - bounds_.low) / cell_m_;
  // Negated, so that what is no number is outside as well.
  if (!(p.x >= 0.0 && p.y >= 0.0 && p.z >= 0.0 && p.x < size_[0] - 1 && p.y < size_[1] - 1 &&
        p.z < size_[2] - 1))
    return false;
  const auto x = static_cast<int>(p.x);
  const auto y = static_cast<int>(p.y);
  const auto z = static_cast<int>(p.z);
  const double fx = p.x - x;
  const double fy = p.y - y;
  const double fz = p.z - z;
  const std::ptrdiff_t row = size_[0];
  const std::ptrdiff_t slice = row * size_[1];
  const float* d = distance_m_.data() + z * slice + y * row + x;
  const auto at = [&](std::ptrdiff_t i) { return static_cast<double>(d[i]); };
  // Along x on the four edges, then y, then z.
  const double a = at(0), b = at(row), c = at(slice), e = at(slice + row);
  const double da = at(1) - a, db = at(row + 1) - b, dc = at(slice + 1) - c,
               de = at(slice + row + 1) - e;
  const double low0 = a + fx * da, low1 = b + fx * db;
  const double high0 = c + fx * dc, high1 = e + fx * de;
  const double low = low0 + fy * (low1 - low0);
  const double high = high0 + fy * (high1 - high0);
  const double dx_low = da + fy * (db - da);
  const double dx_high = dc + fy * (de - dc);
  value.distance_m = low + fz * (high - low);
  value.gradient = Vec3{dx_low + fz * (dx_high - dx_low),
                        (1.0 - fz) * (low1 - low0) + fz * (high1 - high0), high - low} /
                   cell_m_;
  return true;
}

}  // namespace orthonav::nav
