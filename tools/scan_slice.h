#pragma once

#include <span>
#include <string>

#include "base/result.h"
#include "engine/evaluation/evaluation.h"

namespace orthonav::tools {

/// A square cut through a scan, in a vertebra's frame: unit vectors to the right and up in the
/// picture.
struct SlicePlane {
  Point<Vertebra> centre;
  Vec3 right;
  Vec3 up;
  double half_m = 0.032;

  [[nodiscard]] Vec3 toward() const { return right.cross(up); }
};

/// A cylinder drawn over a slice.
struct DrawnCylinder {
  nav::ScrewCylinder cylinder;
  const char* kind = "";  ///< its class in the page's style
};

/// The slice as an SVG with the scan embedded as PNG (from -250 HU black to 2,000 HU white), the
/// outline of the registered bone, and the cylinders: as rectangles if they lie along the slice, as
/// circles if it cuts across them.
Result<std::string> slice_svg(const engine::ScanField& scan, const nav::TriangleMesh& bone,
                              const Transform<engine::Scan, Vertebra>& scan_from_vertebra,
                              const SlicePlane& plane, std::span<const DrawnCylinder> cylinders);

}  // namespace orthonav::tools
