#include "bench/registration_peers.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "nav/geometry/triangle.h"
#include "nav/published/registration.h"

namespace orthonav::bench {

std::vector<Transform<Vertebra, World>> published_starts(std::span<const SurfaceSample> model,
                                                         std::span<const Point<World>> points) {
  std::vector<Vec3> surface;
  surface.reserve(model.size());
  for (const SurfaceSample& sample : model) {
    surface.push_back(sample.point_m);
  }
  std::vector<Vec3> strokes;
  strokes.reserve(points.size());
  for (const Point<World>& point : points) {
    strokes.push_back(point.v);
  }
  const auto poses = nav::published::coarse_poses(nav::published::extreme_points(surface),
                                                  nav::published::extreme_points(strokes));
  std::vector<Transform<Vertebra, World>> starts;
  if (poses) {
    for (const Transform<World, Vertebra>& pose : *poses) {
      starts.push_back(pose.inverse());
    }
  }
  return starts;
}

std::vector<SurfaceSample> surface_samples(const nav::TriangleMesh& mesh, std::size_t count) {
  std::vector<double> area_m2;
  double sum_m2 = 0.0;
  const auto corners = [&](std::size_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    return nav::Triangle{mesh.vertices_m[a], mesh.vertices_m[b], mesh.vertices_m[c]};
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    area_m2.push_back(sum_m2 += nav::triangle_area_m2(corners(t)));
  }
  Random random(1);
  std::vector<SurfaceSample> samples;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = std::lower_bound(area_m2.begin(), area_m2.end(), random.uniform() * sum_m2);
    const nav::Triangle t =
        corners(std::min(static_cast<std::size_t>(at - area_m2.begin()), area_m2.size() - 1));
    const double root = std::sqrt(random.uniform());
    const double along = random.uniform();
    samples.push_back({(1.0 - root) * t[0] + root * (1.0 - along) * t[1] + root * along * t[2],
                       nav::triangle_normal(t)});
  }
  return samples;
}

std::vector<SurfaceSample> exposed(const std::vector<SurfaceSample>& samples,
                                   const std::vector<nav::ScrewPlan>& screws) {
  constexpr double kBeyondEntry_m = 0.005;
  double low_m = 0.0;
  double high_m = 0.0;
  for (const nav::ScrewPlan& screw : screws) {
    low_m = std::min(low_m, screw.entry.v.x - kBeyondEntry_m);
    high_m = std::max(high_m, screw.entry.v.x + kBeyondEntry_m);
  }
  std::vector<SurfaceSample> kept;
  for (const SurfaceSample& sample : samples) {
    if (sample.point_m.x > low_m && sample.point_m.x < high_m) {
      kept.push_back(sample);
    }
  }
  return kept;
}

}  // namespace orthonav::bench
