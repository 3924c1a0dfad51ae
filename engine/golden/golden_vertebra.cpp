#include "engine/golden/golden_vertebra.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nav/geometry/implicit_surface.h"
#include "render/shapes.h"

namespace orthonav::engine {
namespace {

constexpr double kBlend_m = 0.008;
constexpr double kStep_m = 0.0016;

struct Capsule {
  Vec3 from;
  Vec3 to;
  double radius_m;
};

// The left half; the right one is its mirror image.
constexpr std::array<Capsule, 8> kHalf = {{
    {{0.013, 0.010, 0.006}, {0.0145, 0.025, 0.005}, 0.0056},    // pedicle
    {{0.0145, 0.027, 0.004}, {0.004, 0.037, -0.003}, 0.0042},   // lamina, upper half
    {{0.0125, 0.031, -0.008}, {0.003, 0.039, -0.010}, 0.0044},  // lamina, lower half
    {{0.016, 0.025, 0.005}, {0.043, 0.030, 0.009}, 0.0036},     // transverse process
    {{0.0175, 0.029, 0.006}, {0.0185, 0.033, 0.014}, 0.0052},   // superior facet
    {{0.0115, 0.034, -0.010}, {0.013, 0.036, -0.019}, 0.0046},  // inferior facet
    {{0, 0.038, -0.003}, {0, 0.060, -0.008}, 0.0036},           // spinous process, upper edge
    {{0, 0.040, -0.010}, {0, 0.062, -0.018}, 0.0040},           // and lower edge
}};

double capsule_distance(Vec3 p, const Capsule& capsule) {
  const Vec3 along = capsule.to - capsule.from;
  const double t = std::clamp((p - capsule.from).dot(along) / along.squared_norm(), 0.0, 1.0);
  return (p - capsule.from - t * along).norm() - capsule.radius_m;
}

/// Waisted elliptic cylinder with rounded edges.
double body_distance(Vec3 p) {
  constexpr double kHalfHeight_m = 0.014;
  constexpr double kRounding_m = 0.003;
  const double level = std::min(1.0, p.z * p.z / (kHalfHeight_m * kHalfHeight_m));
  const double waist = 0.90 + 0.10 * level;
  const double round = Vec3{p.x / (0.025 * waist), p.y / (0.0175 * waist), 0}.norm();
  const double across = (round - 1.0) * 0.0175 + kRounding_m;
  const double up = std::abs(p.z) - kHalfHeight_m + kRounding_m;
  const double beyond = Vec3{std::max(across, 0.0), std::max(up, 0.0), 0}.norm();
  return beyond + std::min(std::max(across, up), 0.0) - kRounding_m;
}

double smooth_union(double a, double b) {
  const double h = std::max(kBlend_m - std::abs(a - b), 0.0) / kBlend_m;
  return std::min(a, b) - 0.25 * h * h * kBlend_m;
}

double field(Vec3 p) {
  double distance = body_distance(p);
  const Vec3 left = {std::abs(p.x), p.y, p.z};
  for (const Capsule& capsule : kHalf) {
    distance = smooth_union(distance, capsule_distance(left, capsule));
  }
  return distance;
}

}  // namespace

std::shared_ptr<const render::MeshData> make_golden_vertebra() {
  const nav::TriangleMesh surface =
      nav::surface_of(field, {-0.056, -0.026, -0.034}, {0.056, 0.073, 0.028}, kStep_m);
  auto mesh = std::make_shared<render::MeshData>();
  for (const Vec3 v : surface.vertices_m) {
    mesh->positions.push_back(
        {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
  }
  for (const auto& triangle : surface.triangles) {
    mesh->indices.insert(mesh->indices.end(), triangle.begin(), triangle.end());
  }
  mesh->normals = render::smooth_normals(mesh->positions, mesh->indices);
  return mesh;
}

}  // namespace orthonav::engine
