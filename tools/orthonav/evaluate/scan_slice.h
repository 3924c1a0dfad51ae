#pragma once

#include <span>
#include <string>

#include "base/result.h"
#include "engine/evaluation/evaluation.h"
#include "engine/evaluation/slice_plane.h"

namespace orthonav::tools {

/// A cylinder drawn over a slice.
struct DrawnCylinder {
  nav::ScrewCylinder cylinder;
  const char* kind = "";  ///< its class in the page's style
};

/// A square slice as an SVG with the scan embedded as PNG (engine/evaluation/slice_plane.h), the
/// outline of the registered bone, and the cylinders: as rectangles if they lie along the slice, as
/// circles if it cuts across them.
Result<std::string> slice_svg(const engine::ScanField& scan, const nav::TriangleMesh& bone,
                              const Transform<engine::Scan, Vertebra>& scan_from_vertebra,
                              const engine::SlicePlane& plane,
                              std::span<const DrawnCylinder> cylinders);

}  // namespace orthonav::tools
