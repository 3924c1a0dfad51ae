#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/transform.h"
#include "nav/geometry/distance_field.h"

namespace orthonav::nav {

/// A vertebra prepared for the search of every pose: what lies how far from its reachable surface,
/// once finely to descend in, once coarsely to add up in. Immutable.
class SearchField {
 public:
  SearchField(const TriangleMesh& reachable, const SurfaceIndex& reachable_surface,
              const SurfaceIndex& bone);
  /// The same from the samples of `field()`; refuses what is not of these surfaces.
  static Result<SearchField> restored(const TriangleMesh& reachable,
                                      const SurfaceIndex& reachable_surface,
                                      const SurfaceIndex& bone, std::vector<float> samples_m);

  [[nodiscard]] const DistanceField& field() const { return field_; }
  /// What digitized points' centres are tried at.
  [[nodiscard]] const Bounds& reachable_bounds() const { return reachable_bounds_; }

  /// The coarse grid: the cost of a point in each cell, and how far apart neighbours are stored.
  struct Cells {
    Vec3 low_m;
    double cell_m = 0.0;
    std::array<int, 3> size{};
    std::vector<std::uint8_t> cost;
  };
  [[nodiscard]] const Cells& cells() const { return cells_; }

 private:
  SearchField(const Bounds& reachable_bounds, DistanceField field);
  Bounds reachable_bounds_;
  DistanceField field_;
  Cells cells_;
};

/// A pose that fits, and the mean cost of its points there (m²; squared distances, truncated).
struct FoundPose {
  Transform<World, Vertebra> world_from_vertebra;
  double cost_m2 = 0.0;
};

struct PoseSearchOptions {
  std::size_t most = 8;  ///< poses that are returned
  /// Poses nearer to each other than both are one.
  double same_m = 0.003;
  double same_rad = 0.1;
  double tip_radius_m = 0.0;
};

/// The poses at which the points could lie on the surface, the best first: every orientation
/// (a low-discrepancy set, 12° apart on average; Alexa 2022, "Super-Fibonacci spirals") and every
/// place is looked at coarsely, thousands are then refined in the field by robust Gauss-Newton
/// steps. No start, no prior, no axis of the strokes is relied on.
[[nodiscard]] std::vector<FoundPose> search_poses(const SearchField& vertebra,
                                                  std::span<const Vec3> points_in_world_m,
                                                  const PoseSearchOptions& options = {});

}  // namespace orthonav::nav
