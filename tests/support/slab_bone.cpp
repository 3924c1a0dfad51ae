#include "tests/support/slab_bone.h"

#include <cmath>

namespace orthonav::test {
namespace {

constexpr double kHalfWidth_m = 0.035;
constexpr double kHalfHeight_m = 0.025;
constexpr double kFront_m = -0.02;
constexpr std::uint32_t kColumns = 56;
constexpr std::uint32_t kRows = 40;

double bump(double x, double z, double at_x, double at_z, double width_m) {
  const double r2 = (x - at_x) * (x - at_x) + (z - at_z) * (z - at_z);
  return std::exp(-r2 / (width_m * width_m));
}

}  // namespace

nav::TriangleMesh slab_bone(const std::function<double(double, double)>& height_m) {
  nav::TriangleMesh mesh;
  const auto back = [](std::uint32_t column, std::uint32_t row) {
    return row * (kColumns + 1) + column;
  };
  const std::uint32_t fronts = (kColumns + 1) * (kRows + 1);
  for (const bool front : {false, true}) {
    for (std::uint32_t row = 0; row <= kRows; ++row) {
      for (std::uint32_t column = 0; column <= kColumns; ++column) {
        const double x = kHalfWidth_m * (2.0 * column / kColumns - 1.0);
        const double z = kHalfHeight_m * (2.0 * row / kRows - 1.0);
        mesh.vertices_m.push_back({x, front ? kFront_m : height_m(x, z), z});
      }
    }
  }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const std::uint32_t a = back(column, row), b = back(column + 1, row),
                          c = back(column + 1, row + 1), d = back(column, row + 1);
      quad(a, d, c, b);
      quad(a + fronts, b + fronts, c + fronts, d + fronts);
    }
  }
  const auto wall = [&](std::uint32_t a, std::uint32_t b) { quad(a, b, b + fronts, a + fronts); };
  for (std::uint32_t column = 0; column < kColumns; ++column) {
    wall(back(column, 0), back(column + 1, 0));
    wall(back(column + 1, kRows), back(column, kRows));
  }
  for (std::uint32_t row = 0; row < kRows; ++row) {
    wall(back(0, row + 1), back(0, row));
    wall(back(kColumns, row), back(kColumns, row + 1));
  }
  return mesh;
}

double crooked_back(double x, double z) {
  const double from_crest = x - 0.25 * z - 0.004;
  return 0.012 * std::exp(-from_crest * from_crest / (0.007 * 0.007)) +
         0.007 * bump(x, z, 0.024, 0.012, 0.008) + 0.005 * bump(x, z, -0.022, -0.008, 0.010) +
         0.02 * z;
}

double twofold_back(double x, double z) {
  const double from_crest = x - 0.25 * z;
  return 0.012 * std::exp(-from_crest * from_crest / (0.007 * 0.007)) +
         0.006 * (bump(x, z, 0.023, 0.010, 0.009) + bump(x, z, -0.023, -0.010, 0.009));
}

std::vector<Vec3> strokes_over(const nav::SurfaceIndex& surface, std::size_t lanes) {
  std::vector<Vec3> places;
  constexpr int kSteps = 84;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double z =
        0.021 * (2.0 * (static_cast<double>(lane) + 0.5) / static_cast<double>(lanes) - 1.0);
    for (int step = 0; step <= kSteps; ++step) {
      const double along = lane % 2 == 0 ? step : kSteps - step;
      // Slightly oblique, so that no lane follows a row of vertices.
      const double x = 0.029 * (2.0 * along / kSteps - 1.0);
      if (const auto hit = surface.first_hit({x, 0.1, z + 0.04 * x}, {0, -1, 0})) {
        places.push_back(hit->point_m);
      }
    }
  }
  return places;
}

}  // namespace orthonav::test
