#include "nav/published/stroke_pattern.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav::published {
namespace {

constexpr double kPatternStep_m = 0.001;
/// The laminae lie about this far beside the midline.
constexpr double kLamina_m = 0.012;

}  // namespace

std::vector<std::vector<Vec3>> stroke_pattern(const TriangleMesh& trimmed,
                                              const SurfaceIndex& surface) {
  std::vector<std::vector<Vec3>> lines;
  if (trimmed.vertices_m.empty()) {
    return lines;
  }
  const Bounds bounds = bounds_of(trimmed);
  const auto [right, left] =
      std::minmax_element(trimmed.vertices_m.begin(), trimmed.vertices_m.end(),
                          [](Vec3 a, Vec3 b) { return a.x < b.x; });
  const double middle_m = 0.5 * (right->x + left->x);
  const auto add = [&](double from_x, double from_z, double to_x, double to_z) {
    const double length_m = std::hypot(to_x - from_x, to_z - from_z);
    const int steps = std::max(1, static_cast<int>(length_m / kPatternStep_m));
    std::vector<Vec3> line;
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      const Vec3 eye{from_x + t * (to_x - from_x), bounds.high.y + kPatternStep_m,
                     from_z + t * (to_z - from_z)};
      if (const auto hit = surface.first_hit(eye, {0, -1, 0})) {
        line.push_back(eye + hit->distance_m * Vec3{0, -1, 0});
      }
    }
    if (line.size() > 1) {
      lines.push_back(std::move(line));
    }
  };
  const double root_z = 0.5 * (right->z + left->z);
  add(left->x, left->z, middle_m + kLamina_m, root_z);
  add(right->x, right->z, middle_m - kLamina_m, root_z);
  for (const double side : {1.0, -1.0}) {
    add(middle_m + side * kLamina_m, root_z, middle_m + side * kLamina_m,
        0.5 * (root_z + bounds.low.z));
  }
  add(middle_m, root_z, middle_m, bounds.low.z);
  return lines;
}

}  // namespace orthonav::nav::published
