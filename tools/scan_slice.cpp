#include "tools/scan_slice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/io/image_file.h"
#include "engine/report/base64.h"
#include "engine/report/html_text.h"

namespace orthonav::tools {
namespace {

constexpr double kPixelsPerMm = 5.0;
constexpr double kBlack_hu = -250.0;
constexpr double kWhite_hu = 2000.0;

using ScanFromVertebra = Transform<engine::Scan, Vertebra>;

/// Millimetres to the right of and below the picture's middle.
Vec2 on_page_mm(const SlicePlane& plane, Point<Vertebra> place) {
  const Vec3 way = place - plane.centre;
  return {way.dot(plane.right) * 1e3, -way.dot(plane.up) * 1e3};
}

RgbaImage picture_of(const engine::ScanField& scan, const ScanFromVertebra& scan_from_vertebra,
                     const SlicePlane& plane) {
  const int side_px = static_cast<int>(std::lround(2.0 * plane.half_m * 1e3 * kPixelsPerMm));
  RgbaImage out{side_px, side_px, {}};
  for (int y = 0; y < side_px; ++y) {
    for (int x = 0; x < side_px; ++x) {
      const double right_m = (x + 0.5) / (kPixelsPerMm * 1e3) - plane.half_m;
      const double down_m = (y + 0.5) / (kPixelsPerMm * 1e3) - plane.half_m;
      const Point<Vertebra> place = plane.centre + right_m * plane.right - down_m * plane.up;
      const double hu = scan.at((scan_from_vertebra * place).v);
      const double grey = 255.0 * (hu - kBlack_hu) / (kWhite_hu - kBlack_hu);
      const auto byte = static_cast<std::uint8_t>(
          std::isfinite(hu) ? std::clamp(std::lround(grey), 0L, 255L) : 0L);
      out.pixels.insert(out.pixels.end(), {byte, byte, byte, 255});
    }
  }
  return out;
}

/// Where the surface meets the plane: a piece for each triangle.
std::string outline_of(const nav::TriangleMesh& bone, const SlicePlane& plane) {
  std::string path;
  const Vec3 toward = plane.toward();
  const double half_mm = plane.half_m * 1e3;
  for (const auto& triangle : bone.triangles) {
    std::vector<Vec2> ends;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 a = bone.vertices_m[triangle[i]];
      const Vec3 b = bone.vertices_m[triangle[(i + 1) % 3]];
      const double da = (a - plane.centre.v).dot(toward);
      const double db = (b - plane.centre.v).dot(toward);
      if ((da < 0.0) != (db < 0.0)) {
        ends.push_back(on_page_mm(plane, {a + (da / (da - db)) * (b - a)}));
      }
    }
    const bool shown = ends.size() == 2 && std::abs(ends[0].x) < half_mm + 2.0 &&
                       std::abs(ends[0].y) < half_mm + 2.0;
    if (shown) {
      path += engine::formatted("M%.2f %.2fL%.2f %.2f", ends[0].x, ends[0].y, ends[1].x, ends[1].y);
    }
  }
  return "<path class=bone d=\"" + path + "\"/>";
}

std::string shape_of(const nav::ScrewCylinder& cylinder, const SlicePlane& plane) {
  const double radius_mm = cylinder.radius_m * 1e3;
  const double across = cylinder.direction.dot(plane.toward());
  if (std::abs(across) > 0.8) {
    const double s = (plane.centre - cylinder.entry).dot(plane.toward()) / across;
    const Vec2 c = on_page_mm(plane, cylinder.entry + s * cylinder.direction);
    return engine::formatted("<circle cx=%.2f cy=%.2f r=%.2f />", c.x, c.y, radius_mm);
  }
  const Vec2 from = on_page_mm(plane, cylinder.entry);
  const Vec2 to = on_page_mm(plane, cylinder.entry + cylinder.length_m * cylinder.direction);
  const Vec2 way = to - from;
  const Vec2 side = (radius_mm / std::max(way.norm(), 1e-9)) * Vec2{-way.y, way.x};
  const Vec2 a = from + side;
  const Vec2 b = to + side;
  const Vec2 c = to - side;
  const Vec2 d = from - side;
  return engine::formatted("<path d=\"M%.2f %.2fL%.2f %.2f", a.x, a.y, b.x, b.y) +
         engine::formatted("L%.2f %.2fL%.2f %.2fz", c.x, c.y, d.x, d.y) +
         engine::formatted("M%.2f %.2fL%.2f %.2f\"/>", from.x, from.y, to.x, to.y);
}

}  // namespace

Result<std::string> slice_svg(const engine::ScanField& scan, const nav::TriangleMesh& bone,
                              const ScanFromVertebra& scan_from_vertebra, const SlicePlane& plane,
                              std::span<const DrawnCylinder> cylinders) {
  const auto png = engine::png_bytes(picture_of(scan, scan_from_vertebra, plane));
  if (!png) {
    return png.error();
  }
  const double half_mm = plane.half_m * 1e3;
  std::string svg =
      engine::formatted("<svg viewBox=\"%.1f %.1f %.1f %.1f\">", -half_mm, -half_mm, 2.0 * half_mm,
                        2.0 * half_mm) +
      engine::formatted("<image x=%.1f y=%.1f width=%.1f height=%.1f ", -half_mm, -half_mm,
                        2.0 * half_mm, 2.0 * half_mm) +
      "href=\"data:image/png;base64," +
      engine::base64({reinterpret_cast<const std::uint8_t*>(png->data()), png->size()}) + "\"/>" +
      outline_of(bone, plane);
  for (const DrawnCylinder& drawn : cylinders) {
    svg += "<g class=" + std::string(drawn.kind) + ">" + shape_of(drawn.cylinder, plane) + "</g>";
  }
  return svg + "</svg>";
}

}  // namespace orthonav::tools
