#include "tests/support/posterior_landmarks.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace orthonav::test {
namespace {

constexpr double kRow_m = 0.001;
/// No lumbar canal is shallower, but gaps between folds of the surface are.
constexpr double kShallowestCanal_m = 0.006;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Where a ray crosses the surface, from front to back.
std::vector<double> crossings_y_m(const nav::SurfaceIndex& surface, Vec3 from_m) {
  constexpr double kBeyond_m = 1e-5;
  constexpr std::size_t kMost = 32;
  std::vector<double> y_m;
  while (y_m.size() < kMost) {
    const auto hit = surface.first_hit(from_m, {0, 1, 0});
    if (!hit) {
      break;
    }
    y_m.push_back(hit->point_m.y);
    from_m.y = hit->point_m.y + kBeyond_m;
  }
  return y_m;
}

struct CanalRow {
  double z_m;
  double front_y_m;
  double back_y_m;
};

/// The rows in which a ray passes through the body, the canal and the arch.
std::vector<CanalRow> canal_rows(const nav::SurfaceIndex& surface, const nav::Bounds& box,
                                 double x_m) {
  std::vector<CanalRow> rows;
  for (double z = box.low.z; z < box.high.z; z += kRow_m) {
    const auto y = crossings_y_m(surface, {x_m, box.low.y - kRow_m, z});
    if (y.size() >= 4 && y[2] - y[1] > kShallowestCanal_m) {
      rows.push_back({z, y[1], y[2]});
    }
  }
  return rows;
}

}  // namespace

Result<PosteriorLandmarks> find_posterior_landmarks(const nav::TriangleMesh& mesh,
                                                    const nav::SurfaceIndex& surface) {
  const nav::Bounds box = nav::bounds_of(mesh);
  PosteriorLandmarks found{
      .midline_x_m = box.centre().x, .low_z_m = box.low.z, .high_z_m = box.high.z};
  // If one transverse process is longer, it shifts the box, so the middle is taken from the canal
  // itself.
  for (int round = 0; round < 2; ++round) {
    const auto rows = canal_rows(surface, box, found.midline_x_m);
    std::vector<double> middle, half, front, back;
    for (const CanalRow& row : rows) {
      const Vec3 inside{found.midline_x_m, 0.5 * (row.front_y_m + row.back_y_m), row.z_m};
      const auto left = surface.first_hit(inside, {1, 0, 0});
      const auto right = surface.first_hit(inside, {-1, 0, 0});
      front.push_back(row.front_y_m);
      back.push_back(row.back_y_m);
      if (!left || !right) {
        continue;
      }
      middle.push_back(0.5 * (left->point_m.x + right->point_m.x));
      half.push_back(0.5 * (left->point_m.x - right->point_m.x));
    }
    if (half.empty()) {
      return Error{"no canal is found between the vertebra's body and its arch"};
    }
    found.midline_x_m = median(middle);
    found.canal_half_width_m = median(half);
    found.body_back_y_m = median(front);
    found.arch_front_y_m = median(back);
  }
  constexpr double kSpinousHalfWidth_m = 0.008;
  found.crest_y_m = found.arch_front_y_m;
  for (const Vec3 vertex : mesh.vertices_m) {
    if (std::abs(vertex.x - found.midline_x_m) < kSpinousHalfWidth_m) {
      found.crest_y_m = std::max(found.crest_y_m, vertex.y);
    }
  }
  return found;
}

}  // namespace orthonav::test
