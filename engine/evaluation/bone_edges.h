#pragma once

#include <vector>

#include "engine/evaluation/shaft.h"
#include "nav/geometry/mesh.h"

namespace orthonav::engine {

/// A place of a vertebra's surface and the outward normal there, in the model's frame.
struct SurfaceSample {
  Vec3 place_m;
  Vec3 normal;
};

/// At most `wanted` vertices spread evenly over a surface: one for each occupied cube of a grid.
[[nodiscard]] std::vector<SurfaceSample> surface_samples(const nav::TriangleMesh& mesh,
                                                         std::size_t wanted);

/// The neighbourhood of metal, which is excluded from the search for edges of bone.
class MetalMask {
 public:
  /// Masks a box about each voxel of metal, at least `margin_m` to every side.
  MetalMask(const ScanField& scan, double margin_m);
  [[nodiscard]] bool covers(Vec3 place_m) const;

 private:
  VolumeGrid grid_;
  std::vector<bool> masked_;
};

/// The edges of bone in the scan that are seen from a surface at a pose.
struct BoneEdges {
  struct Edge {
    std::size_t sample = 0;
    double outward_m = 0.0;  ///< of the edge in the scan, from the surface along its normal
  };
  std::vector<Edge> edges;
  std::size_t looked_for = 0;  ///< samples inside the scan and clear of metal
  std::size_t outside = 0;     ///< samples outside the scan
};

/// For each sample the place within `within_m` along its normal where the scan falls most steeply
/// from bone (150 HU or more) outward, by 120 HU or more over 1.5 mm; nearer ones are preferred.
[[nodiscard]] BoneEdges bone_edges(const ScanField& scan, const MetalMask& mask,
                                   const std::vector<SurfaceSample>& samples,
                                   const Transform<Scan, Vertebra>& scan_from_vertebra,
                                   double within_m);

}  // namespace orthonav::engine
