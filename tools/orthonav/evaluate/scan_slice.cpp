#include "tools/orthonav/evaluate/scan_slice.h"

#include <algorithm>
#include <cmath>

#include "engine/io/image_file.h"
#include "engine/report/base64.h"
#include "engine/report/html_text.h"

namespace orthonav::tools {
namespace {

constexpr double kPixelsPerMm = 5.0;

using engine::SlicePlane;
using ScanFromVertebra = Transform<engine::Scan, Vertebra>;

/// Millimetres to the right of and below the picture's middle.
Vec2 on_page_mm(const SlicePlane& plane, Point<Vertebra> place) {
  const Vec2 at = plane.in_plane(place);
  return {at.x * 1e3, -at.y * 1e3};
}

RgbaImage picture_of(const engine::ScanField& scan, const ScanFromVertebra& scan_from_vertebra,
                     const SlicePlane& plane) {
  const int side_px = static_cast<int>(std::lround(2.0 * plane.half_m * 1e3 * kPixelsPerMm));
  RgbaImage out{side_px, side_px, {}};
  engine::draw_slice(scan, scan_from_vertebra, plane, engine::kMetalWindow, out);
  return out;
}

std::string outline_of(const nav::TriangleMesh& bone, const SlicePlane& plane) {
  std::string path;
  const double half_mm = plane.half_m * 1e3;
  for (const auto& [a, b] : engine::outline_in(plane, bone)) {
    const Vec2 from = {a.x * 1e3, -a.y * 1e3};
    const Vec2 to = {b.x * 1e3, -b.y * 1e3};
    const bool shown = std::abs(from.x) < half_mm + 2.0 && std::abs(from.y) < half_mm + 2.0;
    if (shown) {
      path += engine::formatted("M%.2f %.2fL%.2f %.2f", from.x, from.y, to.x, to.y);
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
