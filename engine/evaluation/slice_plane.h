#pragma once

#include <array>
#include <vector>

#include "base/image.h"
#include "engine/evaluation/scan_field.h"
#include "nav/geometry/mesh.h"
#include "nav/guidance/screw.h"

namespace orthonav::engine {

/// A rectangle cut through a vertebra: unit vectors to the right and up in the picture.
struct SlicePlane {
  Point<Vertebra> centre;
  Vec3 right;
  Vec3 up;
  double half_m = 0.032;  ///< of its height

  /// Towards who looks at the picture.
  [[nodiscard]] Vec3 toward() const { return right.cross(up); }
  /// To the right of and above the centre, metres.
  [[nodiscard]] Vec2 in_plane(Point<Vertebra> place) const {
    const Vec3 way = place - centre;
    return {way.dot(right), way.dot(up)};
  }
  [[nodiscard]] Point<Vertebra> at(Vec2 in_plane_m) const {
    return centre + in_plane_m.x * right + in_plane_m.y * up;
  }
};

/// The planes in which a screw is judged. The patient's front is up in `axial`, seen from below,
/// and to the left in `sagittal`, seen from the patient's left; `across` is seen from the front.
/// The patient's right is on the left in `axial` and `across`.
struct ScrewSlices {
  SlicePlane axial;     ///< through the axis and as horizontal as it allows
  SlicePlane sagittal;  ///< through the axis and as upright as it allows
  SlicePlane across;    ///< at right angles to it, smaller
};
/// `axis` as unit vector into the bone, not along the patient's left or long axis. `across` cuts it
/// this far past the entry.
[[nodiscard]] ScrewSlices slices_of(const nav::Axis<Vertebra>& axis, double length_m,
                                    double across_m);

/// The densities that are drawn black and white.
struct GreyWindow {
  double black_hu = 0.0;
  double white_hu = 0.0;
};
inline constexpr GreyWindow kBoneWindow{-250.0, 1250.0};
inline constexpr GreyWindow kMetalWindow{-250.0, 2000.0};

/// The scan in that plane, opaque; black outside of it. `picture` has its size already.
void draw_slice(const ScanField& scan, const Transform<Scan, Vertebra>& scan_from_vertebra,
                const SlicePlane& plane, const GreyWindow& window, RgbaImage& picture);

/// Where a surface meets the plane, a piece for each triangle: its ends, as by `in_plane`.
using SlicePiece = std::array<Vec2, 2>;
[[nodiscard]] std::vector<SlicePiece> outline_in(const SlicePlane& plane,
                                                 const nav::TriangleMesh& surface);

}  // namespace orthonav::engine
