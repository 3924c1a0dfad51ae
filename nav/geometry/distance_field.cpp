#include "nav/geometry/distance_field.h"

#include <cmath>
#include <limits>

namespace orthonav::nav {

DistanceField::DistanceField(const TriangleMesh& mesh, const SurfaceIndex& near,
                             const SurfaceIndex& bone, double cell_m, double margin_m)
    : cell_m_(cell_m) {
  const Bounds box = bounds_of(mesh);
  const Vec3 margin{margin_m, margin_m, margin_m};
  bounds_.low = box.low - margin;
  const Vec3 extent = box.high + margin - bounds_.low;
  for (std::size_t k = 0; k < 3; ++k) {
    size_[k] = static_cast<int>(std::ceil(extent[static_cast<int>(k)] / cell_m)) + 1;
  }
  bounds_.high = bounds_.low + cell_m * Vec3{size_[0] - 1.0, size_[1] - 1.0, size_[2] - 1.0};

  // Near the surface distances are exact. Farther off, one of the neighbours' closest points is the
  // closest one, or nearly (Danielsson 1980, "Euclidean distance mapping").
  struct Closest {
    Vec3 point_m;
    double distance2 = std::numeric_limits<double>::infinity();
  };
  const double exact_m = 2.5 * cell_m;
  std::vector<Closest> samples(sample(0, 0, size_[2]));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (const auto found = near.nearest(place_m(i), exact_m)) {
      samples[i] = {found->point_m, found->distance_m * found->distance_m};
    }
  }
  // Of a sample's 26 neighbours, 13 come before it in their order. Forwards with these, backwards
  // with the other 13; twice, since the way from the surface may turn.
  for (const int side : {-1, 1, -1, 1}) {
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const std::size_t i = side < 0 ? k : samples.size() - 1 - k;
      Closest& here = samples[i];
      if (here.distance2 <= exact_m * exact_m) {
        continue;
      }
      const auto [x, y, z] = indices(i);
      const Vec3 place = place_m(i);
      for (int neighbour = 0; neighbour < 13; ++neighbour) {
        const int beside_x = x + side * (1 - neighbour % 3);
        const int beside_y = y + side * (1 - neighbour / 3 % 3);
        const int beside_z = z + side * (1 - neighbour / 9);
        if (beside_x < 0 || beside_y < 0 || beside_z < 0 || beside_x >= size_[0] ||
            beside_y >= size_[1] || beside_z >= size_[2]) {
          continue;
        }
        const Closest& beside = samples[sample(beside_x, beside_y, beside_z)];
        if (std::isfinite(beside.distance2)) {
          const double distance2 = (beside.point_m - place).squared_norm();
          if (distance2 < here.distance2) {
            here = {beside.point_m, distance2};
          }
        }
      }
    }
  }

  // Where the bone's surface is farther than the neighbour, both lie on the same side of it. Half
  // a cell more keeps the neighbour itself off the surface.
  const double clear_m = 1.5 * cell_m;
  bool inside = false;
  distance_m_.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec3 place = place_m(i);
    if (const auto beside = bone.nearest(place, clear_m)) {
      inside = bone.contains(place, *beside);
    } else if (indices(i)[0] == 0) {
      inside = bone.contains(place);
    }
    const double distance_m = std::sqrt(samples[i].distance2);
    distance_m_.push_back(static_cast<float>(inside ? -distance_m : distance_m));
  }
}

std::size_t DistanceField::sample(int x, int y, int z) const {
  const auto row = static_cast<std::size_t>(size_[0]);
  const auto rows = static_cast<std::size_t>(size_[1]);
  return (static_cast<std::size_t>(z) * rows + static_cast<std::size_t>(y)) * row +
         static_cast<std::size_t>(x);
}

std::array<int, 3> DistanceField::indices(std::size_t sample) const {
  const auto row = static_cast<std::size_t>(size_[0]);
  const std::size_t slice = row * static_cast<std::size_t>(size_[1]);
  return {static_cast<int>(sample % row), static_cast<int>(sample % slice / row),
          static_cast<int>(sample / slice)};
}

Vec3 DistanceField::place_m(std::size_t sample) const {
  const auto [x, y, z] = indices(sample);
  return bounds_.low + cell_m_ * Vec3{1.0 * x, 1.0 * y, 1.0 * z};
}

bool DistanceField::at(Vec3 query_m, Value& value) const {
  const Vec3 p = (query_m - bounds_.low) / cell_m_;
  // Negated, so that NaN counts as outside.
  if (!(p.x >= 0.0 && p.y >= 0.0 && p.z >= 0.0 && p.x < size_[0] - 1 && p.y < size_[1] - 1 &&
        p.z < size_[2] - 1)) {
    return false;
  }
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
