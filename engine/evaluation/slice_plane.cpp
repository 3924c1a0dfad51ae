#include "engine/evaluation/slice_plane.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace orthonav::engine {
namespace {

std::uint8_t grey_of(double hu, const GreyWindow& window) {
  const double grey = 255.0 * (hu - window.black_hu) / (window.white_hu - window.black_hu);
  return static_cast<std::uint8_t>(std::isfinite(hu) ? std::clamp(std::lround(grey), 0L, 255L)
                                                     : 0L);
}

Vec3 part_across(Vec3 v, Vec3 direction) { return (v - v.dot(direction) * direction).normalized(); }

}  // namespace

ScrewSlices slices_of(const nav::Axis<Vertebra>& axis, double length_m, double across_m) {
  constexpr double kAcrossHalf_m = 0.018;
  const Vec3 d = axis.direction;
  const Vec3 left = part_across({1, 0, 0}, d);
  const Vec3 cranial = part_across({0, 0, 1}, d);
  const Point<Vertebra> middle = axis.point + 0.45 * length_m * d;
  return {{middle, left, d},
          {middle, -d, cranial},
          {axis.point + across_m * d, part_across(left, cranial), cranial, kAcrossHalf_m}};
}

void draw_slice(const ScanField& scan, const Transform<Scan, Vertebra>& scan_from_vertebra,
                const SlicePlane& plane, const GreyWindow& window, RgbaImage& picture) {
  const double pixel_m = 2.0 * plane.half_m / picture.height_px;
  picture.pixels.clear();
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      const Vec2 at{(x + 0.5 - 0.5 * picture.width_px) * pixel_m,
                    (0.5 * picture.height_px - y - 0.5) * pixel_m};
      const double hu = scan.at((scan_from_vertebra * plane.at(at)).v);
      const std::uint8_t grey = grey_of(hu, window);
      picture.pixels.insert(picture.pixels.end(), {grey, grey, grey, 255});
    }
  }
}

std::vector<SlicePiece> outline_in(const SlicePlane& plane, const nav::TriangleMesh& surface) {
  std::vector<SlicePiece> pieces;
  const Vec3 toward = plane.toward();
  for (const auto& triangle : surface.triangles) {
    SlicePiece piece{};
    std::size_t ends = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 a = surface.vertices_m[triangle[i]];
      const Vec3 b = surface.vertices_m[triangle[(i + 1) % 3]];
      const double da = (a - plane.centre.v).dot(toward);
      const double db = (b - plane.centre.v).dot(toward);
      if ((da < 0.0) != (db < 0.0) && ends < 2) {
        piece[ends++] = plane.in_plane({a + (da / (da - db)) * (b - a)});
      }
    }
    if (ends == 2) {
      pieces.push_back(piece);
    }
  }
  return pieces;
}

}  // namespace orthonav::engine
