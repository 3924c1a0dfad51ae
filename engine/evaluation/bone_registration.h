#pragma once

#include "engine/evaluation/bone_edges.h"
#include "nav/registration/tre.h"

namespace orthonav::engine {

/// A vertebra registered to its bone in the scan.
struct BoneRegistration {
  Transform<Scan, Vertebra> scan_from_vertebra;
  /// Mean distance of the edges outside the surface, at most 1 mm; subtracted before the figures
  /// below are computed.
  double offset_m = 0.0;
  double residual_m = 0.0;   ///< median distance of an edge in the scan from the surface
  double coverage = 0.0;     ///< share of the samples, clear of metal, whose edge lies within 1 mm
  double inside_scan = 0.0;  ///< share of the samples inside the scan
  std::size_t edges = 0;
  nav::PoseUncertainty uncertainty;  ///< in the model's frame
};

/// A fit is refused with less of the vertebra in the scan.
inline constexpr double kLeastInsideScan = 0.60;

/// Fits the surface to the edges of bone in the scan from a start within some millimetres and
/// degrees: point to plane (Chen and Medioni 1992) with Tukey's weights. Each round searches the
/// edges anew, within a distance along the normals that shrinks from `within_m` to 1.5 mm. Does not
/// judge the fit: `refusal` does. If the edges do not determine the pose, the coverage is 0.
[[nodiscard]] BoneRegistration laid_on_bone(const ScanField& scan, const MetalMask& mask,
                                            const std::vector<SurfaceSample>& samples,
                                            const Transform<Scan, Vertebra>& start,
                                            double within_m);

/// Why the fit is refused, in one line; empty if it is accepted.
[[nodiscard]] std::string refusal(const BoneRegistration& found);

}  // namespace orthonav::engine
