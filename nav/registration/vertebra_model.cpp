#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "nav/geometry/triangle.h"
#include "nav/registration/registration.h"
#include "nav/registration/trimming.h"

namespace orthonav::nav {
namespace {

// Fine enough to separate crests, coarse enough to be computed in a fraction of a second.
constexpr double kGridCell_m = 0.003;
constexpr double kGridMargin_m = 0.02;

/// Weighted by area, so that a finely meshed corner counts only for its size.
PrincipalAxes axes_by_area(const TriangleMesh& mesh) {
  std::vector<Vec3> centres_m;
  std::vector<double> areas_m2;
  for (const auto& t : mesh.triangles) {
    const Triangle corners{mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]};
    centres_m.push_back((corners[0] + corners[1] + corners[2]) / 3.0);
    areas_m2.push_back(triangle_area_m2(corners));
  }
  return principal_axes(centres_m, areas_m2);
}

std::vector<std::uint32_t> all_faces(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> faces(mesh.triangles.size());
  std::iota(faces.begin(), faces.end(), 0U);
  return faces;
}

Status check_faces(const TriangleMesh& mesh, const SurfaceIndex& surface,
                   const std::vector<std::uint32_t>& faces) {
  constexpr std::size_t kLookedAt = 300;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i] >= mesh.triangles.size() || (i > 0 && faces[i] <= faces[i - 1])) {
      return Error{"reachable faces are not in order, or not the mesh's"};
    }
  }
  for (std::size_t i = 0; i < faces.size();
       i += std::max<std::size_t>(1, faces.size() / kLookedAt)) {
    if (!is_visible_from_behind(mesh, surface, faces[i])) {
      return Error{"reachable faces are of another mesh (face " + std::to_string(faces[i]) + ")"};
    }
  }
  return {};
}

}  // namespace

/// The common start of both ways to make a model.
struct VertebraModel::Surfaces {
  Surfaces(TriangleMesh whole, SurfaceIndex index, std::vector<std::uint32_t> faces)
      : mesh(std::move(whole)),
        surface(std::move(index)),
        reachable_faces(std::move(faces)),
        reachable(part_of(mesh, reachable_faces)),
        reachable_surface(reachable) {}

  TriangleMesh mesh;
  SurfaceIndex surface;
  std::vector<std::uint32_t> reachable_faces;
  TriangleMesh reachable;
  SurfaceIndex reachable_surface;
};

Result<std::shared_ptr<const VertebraModel>> VertebraModel::prepare(TriangleMesh mesh, Bone bone) {
  auto checked = checked_bone(std::move(mesh), bone);
  if (!checked) {
    return checked.error();
  }
  SurfaceIndex surface(*checked);
  std::vector<std::uint32_t> faces = bone == Bone::kVertebra
                                         ? faces_reachable_from_behind(*checked, surface)
                                         : all_faces(*checked);
  if (faces.empty()) {
    return Error{
        "model has no surface that a pointer can reach from behind (+y): its axes must be "
        "LPS"};
  }
  Surfaces s(std::move(*checked), std::move(surface), std::move(faces));
  ClosestGrid grid(s.reachable, s.reachable_surface, kGridCell_m, kGridMargin_m);
  SearchField field(s.reachable, s.reachable_surface, s.surface);
  return std::shared_ptr<const VertebraModel>(
      new VertebraModel(bone, std::move(s), std::move(grid), std::move(field)));
}

Result<std::shared_ptr<const VertebraModel>> VertebraModel::restore(TriangleMesh mesh,
                                                                    PreparedParts parts) {
  auto checked = checked_bone(std::move(mesh));
  if (!checked) {
    return checked.error();
  }
  if (parts.reachable.empty()) {
    return Error{"no reachable faces"};
  }
  SurfaceIndex surface(*checked);
  if (const Status s = check_faces(*checked, surface, parts.reachable); !s) {
    return s.error();
  }
  Surfaces s(std::move(*checked), std::move(surface), std::move(parts.reachable));
  auto grid = ClosestGrid::restored(s.reachable, s.reachable_surface, kGridCell_m, kGridMargin_m,
                                    std::move(parts.closest_m));
  if (!grid) {
    return grid.error();
  }
  auto field = SearchField::restored(s.reachable, s.reachable_surface, s.surface,
                                     std::move(parts.distance_m));
  if (!field) {
    return field.error();
  }
  return std::shared_ptr<const VertebraModel>(
      new VertebraModel(Bone::kVertebra, std::move(s), std::move(*grid), std::move(*field)));
}

PreparedParts VertebraModel::parts() const {
  const auto closest = reachable_grid_.closest_m();
  const auto distance = search_field_.field().samples_m();
  return {reachable_faces_, {closest.begin(), closest.end()}, {distance.begin(), distance.end()}};
}

VertebraModel::VertebraModel(Bone bone, Surfaces surfaces, ClosestGrid grid, SearchField field)
    : bone_(bone),
      mesh_(std::move(surfaces.mesh)),
      reachable_faces_(std::move(surfaces.reachable_faces)),
      reachable_(std::move(surfaces.reachable)),
      surface_(std::move(surfaces.surface)),
      reachable_surface_(std::move(surfaces.reachable_surface)),
      reachable_grid_(std::move(grid)),
      reachable_axes_(axes_by_area(reachable_)),
      search_field_(std::move(field)) {}

}  // namespace orthonav::nav
