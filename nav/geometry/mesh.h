#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/transform.h"
#include "nav/geometry/box_tree.h"

namespace orthonav::nav {

/// A closed triangle surface in its model's frame, metres, outward-oriented.
struct TriangleMesh {
  std::vector<Vec3> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// An axis-parallel box, metres.
struct Bounds {
  Vec3 low;
  Vec3 high;
  [[nodiscard]] Vec3 centre() const { return 0.5 * (low + high); }
};
/// The bounds of the vertices that faces refer to; stray vertices are ignored. Zero without faces.
[[nodiscard]] Bounds bounds_of(const TriangleMesh& mesh);

/// What a closed surface encloses, by the divergence theorem.
struct Solid {
  double volume_m3 = 0.0;  ///< negative for an inward-oriented surface
  Vec3 centroid_m;
};
[[nodiscard]] Solid solid_of(const TriangleMesh& mesh);

/// What a model is of. `kAny` is any other bone: nothing is known of its axes.
enum class Bone : std::uint8_t { kVertebra, kAny };

/// Refuses a mesh that can't be navigated on, with the reason: no faces, non-finite vertices, an
/// index out of range, edges not shared by exactly two triangles (non-manifold or open), a size
/// outside 30-250 mm for a vertebra (which is 60-130 mm across), 30-600 mm for another bone; the
/// message says so if metres were taken for millimetres. A mesh that is closed but oriented inward
/// is turned inside out.
Result<TriangleMesh> checked_bone(TriangleMesh mesh, Bone bone = Bone::kVertebra);

/// The same surface with vertices at exactly the same position merged, without the faces that
/// collapse as a result: needed before the check above for a format without shared vertices (STL).
TriangleMesh welded(const TriangleMesh& mesh);

/// For each face the number of the connected part that it belongs to, which is the index of one of
/// the part's vertices; faces that share a vertex are connected. For faces that are not `kept` the
/// number is meaningless.
std::vector<std::uint32_t> parts_of(const TriangleMesh& mesh, const std::vector<bool>& kept);

/// The mesh of these faces, which must be the given mesh's own, with the vertices that they use.
TriangleMesh part_of(const TriangleMesh& mesh, std::span<const std::uint32_t> faces);

/// The largest part by the volume that it encloses, and how many others were left out: islands of a
/// segmentation, cavities in the bone. A closed part goes before an open one of less than ten times
/// its volume. A mesh that names vertices it does not have comes back as it is.
struct MainPart {
  TriangleMesh mesh;
  std::size_t left_out = 0;
};
[[nodiscard]] MainPart main_part(TriangleMesh mesh);

struct SurfacePoint {
  Vec3 point_m;
  Vec3 normal;  ///< of the triangle, outward
  double distance_m = 0.0;
  std::uint32_t triangle = 0;
};

struct RayHit {
  Vec3 point_m;
  Vec3 normal;
  double distance_m = 0.0;
  std::uint32_t triangle = 0;
};

/// Distance queries on a mesh by a bounding volume hierarchy. Immutable, thread-safe, no
/// allocation in queries.
class SurfaceIndex {
 public:
  explicit SurfaceIndex(const TriangleMesh& mesh);
  /// The nearest point of the surface; the search is limited to `within_m`.
  [[nodiscard]] std::optional<SurfacePoint> nearest(Vec3 query_m, double within_m = 1e9) const;
  /// First intersection along origin + s·direction, s ≥ 0; `direction` of any length.
  [[nodiscard]] std::optional<RayHit> first_hit(Vec3 origin_m, Vec3 direction) const;
  /// Whether a closed, outward-oriented surface encloses the point.
  [[nodiscard]] bool contains(Vec3 query_m) const;
  /// The same, sooner, where its nearest point is known.
  [[nodiscard]] bool contains(Vec3 query_m, const SurfacePoint& nearest) const;

 private:
  BoxTree boxes_;
  std::vector<std::array<Vec3, 3>> corners_;  ///< in the order of the boxes
  std::vector<std::uint32_t> original_;
};

}  // namespace orthonav::nav
