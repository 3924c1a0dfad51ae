#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/transform.h"
#include "nav/geometry/distance_field.h"

namespace orthonav::nav {

/// A vertebra prepared for the search over all poses: distances to its reachable surface, on a fine
/// grid for descent and on a coarse one for summing costs. Immutable.
class SearchField {
 public:
  SearchField(const TriangleMesh& reachable, const SurfaceIndex& reachable_surface,
              const SurfaceIndex& bone);
  /// The same from the samples of `field()`; refuses samples of other surfaces.
  static Result<SearchField> restored(const TriangleMesh& reachable,
                                      const SurfaceIndex& reachable_surface,
                                      const SurfaceIndex& bone, std::vector<float> samples_m);

  [[nodiscard]] const DistanceField& field() const { return field_; }
  /// The box within which the centre of the digitized points is tried.
  [[nodiscard]] const Bounds& reachable_bounds() const { return reachable_bounds_; }

  /// The coarse grid: the cost of a point in each cell. Along x, cells that are kApart apart are
  /// stored next to each other, so that the search reads kRun neighbouring places at once.
  struct Cells {
    static constexpr int kApart = 4;
    static constexpr int kRun = 16;  ///< places that are read at once

    Vec3 low_m;
    double cell_m = 0.0;
    std::array<int, 3> size{};
    std::vector<std::uint8_t> cost;

    [[nodiscard]] std::ptrdiff_t lane() const { return (size[0] + kApart - 1) / kApart; }
    [[nodiscard]] std::ptrdiff_t row() const { return kApart * lane(); }
    [[nodiscard]] std::ptrdiff_t slice() const { return row() * size[1]; }
    [[nodiscard]] std::ptrdiff_t index(int x, int y, int z) const {
      return z * slice() + y * row() + (x % kApart) * lane() + x / kApart;
    }
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
  std::size_t most = 8;  ///< poses to return
  /// Two poses closer than both of these count as one.
  double same_m = 0.003;
  double same_rad = 0.1;
  double tip_radius_m = 0.0;
};

/// The poses at which the points could lie on the surface, the best first. Every orientation (a
/// low-discrepancy set, 12° apart on average; Alexa 2022, "Super-Fibonacci spirals") and every
/// place is examined coarsely; thousands are then refined in the field by robust Gauss-Newton
/// steps. Needs no start, no prior and no axis of the strokes.
[[nodiscard]] std::vector<FoundPose> search_poses(const SearchField& vertebra,
                                                  std::span<const Vec3> points_in_world_m,
                                                  const PoseSearchOptions& options = {});

}  // namespace orthonav::nav
