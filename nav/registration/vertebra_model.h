#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/result.h"
#include "base/transform.h"
#include "nav/geometry/distance_field.h"
#include "nav/geometry/mesh.h"
#include "nav/geometry/principal_axes.h"

namespace orthonav::nav {

/// The faces of a vertebra (axes LPS, closed, outward-oriented, metres) that a pointer coming from
/// behind can touch: faces with a free line of sight to the back, within 75 degrees to either side
/// and 40 degrees up and down, and behind the front wall of the canal. This excludes the body's
/// wall even where it can be seen between the laminae, since soft tissue covers it. Small islands
/// are dropped. Ascending.
std::vector<std::uint32_t> faces_reachable_from_behind(const TriangleMesh& mesh,
                                                       const SurfaceIndex& surface);

/// A vertebra prepared for the search over all poses: distances to its reachable surface, on a fine
/// grid for descent and on a coarse one for summing costs. Immutable.
class SearchField {
 public:
  /// Points on the back of a vertebra lie within this distance of their centre; farther ones are
  /// outliers.
  static constexpr double kReach_m = 0.075;

  SearchField(const TriangleMesh& reachable, const SurfaceIndex& reachable_surface,
              const SurfaceIndex& bone);

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
  Bounds reachable_bounds_;
  DistanceField field_;
  Cells cells_;
};

/// The preoperative vertebra, prepared once: its mesh (frame Vertebra: LPS axes, metres), the part
/// a pointer can reach from behind, and their indices. Of any other bone the whole surface counts
/// as reachable.
class VertebraModel {
 public:
  static Result<std::shared_ptr<const VertebraModel>> prepare(TriangleMesh mesh,
                                                              Bone bone = Bone::kVertebra);

  [[nodiscard]] Bone bone() const { return bone_; }
  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  [[nodiscard]] const SurfaceIndex& surface() const { return surface_; }
  /// The posterior part: what is left after trimming what a pointer can't reach.
  [[nodiscard]] const TriangleMesh& reachable() const { return reachable_; }
  [[nodiscard]] const SurfaceIndex& reachable_surface() const { return reachable_surface_; }
  /// Its faces in `mesh()`, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& reachable_faces() const {
    return reachable_faces_;
  }
  /// Principal axes of the reachable surface, by area.
  [[nodiscard]] const PrincipalAxes& reachable_axes() const { return reachable_axes_; }
  /// For the search of every pose.
  [[nodiscard]] const SearchField& search_field() const { return search_field_; }

 private:
  VertebraModel(Bone bone, TriangleMesh mesh, SurfaceIndex surface,
                std::vector<std::uint32_t> reachable_faces);
  Bone bone_;
  TriangleMesh mesh_;
  SurfaceIndex surface_;
  std::vector<std::uint32_t> reachable_faces_;
  TriangleMesh reachable_;
  SurfaceIndex reachable_surface_;
  PrincipalAxes reachable_axes_;
  SearchField search_field_;
};

}  // namespace orthonav::nav
