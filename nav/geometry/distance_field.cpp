#include "nav/geometry/distance_field.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace orthonav::nav {
namespace {

float signed_distance_m(double distance_m, bool inside) {
  return static_cast<float>(inside ? -distance_m : distance_m);
}

}  // namespace

DistanceField::DistanceField(const TriangleMesh& mesh, double cell_m, double margin_m)
    : cell_m_(cell_m) {
  const Bounds box = bounds_of(mesh);
  const Vec3 margin{margin_m, margin_m, margin_m};
  bounds_.low = box.low - margin;
  const Vec3 extent = box.high + margin - bounds_.low;
  for (std::size_t k = 0; k < 3; ++k) {
    size_[k] = static_cast<int>(std::ceil(extent[static_cast<int>(k)] / cell_m)) + 1;
  }
  bounds_.high = bounds_.low + cell_m * Vec3{size_[0] - 1.0, size_[1] - 1.0, size_[2] - 1.0};
}

std::size_t DistanceField::count() const {
  return static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
         static_cast<std::size_t>(size_[2]);
}

Vec3 DistanceField::place_m(std::size_t sample) const {
  const auto row = static_cast<std::size_t>(size_[0]);
  const std::size_t slice = row * static_cast<std::size_t>(size_[1]);
  return bounds_.low + cell_m_ * Vec3{static_cast<double>(sample % row),
                                      static_cast<double>(sample % slice / row),
                                      static_cast<double>(sample / slice)};
}

DistanceField::DistanceField(const TriangleMesh& mesh, const SurfaceIndex& near,
                             const SurfaceIndex& bone, double cell_m, double margin_m)
    : DistanceField(mesh, cell_m, margin_m) {
  const std::size_t samples = count();
  const auto row = static_cast<std::size_t>(size_[0]);
  distance_m_.reserve(samples);
  Vec3 closest_m;
  bool inside = false;
  for (std::size_t i = 0; i < samples; ++i) {
    const Vec3 place = place_m(i);
    // The surface is no farther than its point that is closest to the neighbour.
    double within_m = i % row > 0 ? (closest_m - place).norm() * (1.0 + 1e-12) + 1e-15 : 1e9;
    if (const auto found = near.nearest(place, within_m)) {
      closest_m = found->point_m;
      within_m = found->distance_m;
    }
    // Where the bone's surface is farther than the neighbour, both lie on the same side of it. Half
    // a cell more keeps the neighbour itself off the surface.
    const double clear_m = 1.5 * cell_m;
    if (i % row == 0 || within_m < clear_m || bone.nearest(place, clear_m)) {
      inside = bone.contains(place);
    }
    distance_m_.push_back(signed_distance_m(within_m, inside));
  }
}

Result<DistanceField> DistanceField::restored(const TriangleMesh& mesh, const SurfaceIndex& near,
                                              const SurfaceIndex& bone, double cell_m,
                                              double margin_m, std::vector<float> samples_m) {
  constexpr std::size_t kLookedAt = 300;
  constexpr double kSame_m = 1e-7;  // floats of up to 0.3 m
  DistanceField field(mesh, cell_m, margin_m);
  const std::size_t samples = field.count();
  if (samples_m.size() != samples) {
    return Error{"distances at " + std::to_string(samples_m.size()) + " places, the mesh has " +
                 std::to_string(samples)};
  }
  if (!std::all_of(samples_m.begin(), samples_m.end(), [](float d) { return std::isfinite(d); })) {
    return Error{"distances are not all finite"};
  }
  for (std::size_t i = 0; i < samples; i += std::max<std::size_t>(1, samples / kLookedAt)) {
    const Vec3 place = field.place_m(i);
    const auto found = near.nearest(place);
    const double right_m =
        found ? static_cast<double>(signed_distance_m(found->distance_m, bone.contains(place)))
              : 0.0;
    if (!found || !(std::abs(static_cast<double>(samples_m[i]) - right_m) <= kSame_m)) {
      return Error{"distances are of another mesh (place " + std::to_string(i) + ")"};
    }
  }
  field.distance_m_ = std::move(samples_m);
  return field;
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
